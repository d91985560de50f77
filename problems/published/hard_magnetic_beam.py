"""Hard-magnetic soft cantilever in a field across it: the experiment of Zhao et al. (2019), as digitised by others."""

from __future__ import annotations

from dataclasses import dataclass

from problems.exact.hard_magnetic_elastica import load
from problems.published.case import Confidence, columns


@dataclass(frozen=True)
class BeamExperiment:
    """SI units. `table`: "field" in mT and "deflection", the tip's displacement along the field over the length."""

    name: str
    source: str
    length: float
    thickness: float
    width: float
    shear_modulus: float
    magnetisation: float
    table: dict[str, tuple[float, ...]]
    confidence: Confidence
    notes: str

    def load(self, field: float) -> float:
        """The elastica's load at a field in T, with E = 3 mu: the beam is free to contract across."""
        permeability = 1.25663706212e-6
        remanence = permeability * self.magnetisation
        return load(self.length, self.thickness, 3.0 * self.shear_modulus, remanence, field, permeability)


ZHAO = BeamExperiment(
    name="hard-magnetic soft beam, remanence along it, field across it",
    source="R. Zhao, Y. Kim, S. A. Chester, P. Sharma, X. Zhao, Mechanics of hard-magnetic soft materials, J. Mech. "
    "Phys. Solids 124 (2019) 244-263; digitised in the repository "
    "ericstewart36/hardmagnetics_fenicsx (HM01_beam_bending)",
    length=17.2e-3,
    thickness=0.84e-3,
    width=5.0e-3,
    shear_modulus=303e3,
    magnetisation=114e3,
    table=columns(
        "field deflection",
        """
        0.000 0.001
        1.856 0.316
        2.785 0.415
        3.753 0.514
        4.641 0.592
        5.650 0.618
        6.578 0.678
        9.443 0.755
        14.124 0.833
        18.846 0.853
        23.567 0.882
        37.772 0.886
        47.175 0.899
        """,
    ),
    confidence="high",
    notes="Scatter of the digitisation 3 to 5 per cent; the elastica agrees within 0.042.",
)
