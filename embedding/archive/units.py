"""Units of the scalars that a step records, by name; a plane-strain run counts everything per length of
cylinder."""

from __future__ import annotations

UNITS = {
    "pressure_top": "Pa",
    "pressure_bottom": "Pa",
    "pressure_difference": "Pa",
    "min_principal_stress": "Pa",
    "displacement": "m",
}
EXTENSIVE = {
    "field_energy": "J", "elastic_energy": "J", "load_work": "J", "support_work": "J", "held_force": "N",
}  # fmt: skip
OF_PARTS = {"voltage": "V", "charge": "C", "potential": "A", "flux": "Wb", "force": "N", "torque": "N m", "u": "m"}
"""Of the shell, of its film, of a body, along an axis, of a point: ``charge_body0``, ``torque_z``, ``u_tip_x``."""
PER_LENGTH = {"J": "J/m", "N": "N/m", "C": "C/m", "Wb": "Wb/m", "N m": "N"}


def scalar_unit(name: str, per_length: bool = False) -> str:
    """SI unit of the scalar ``name``; "1" if it has none or the name is not known.

    ``per_length`` says that extensive quantities (charge, energy, force) are those of a metre of cylinder.
    """
    unit = EXTENSIVE.get(name) or OF_PARTS.get(name.split("_")[0])
    if unit is not None:
        return PER_LENGTH.get(unit, unit) if per_length else unit
    return UNITS.get(name, "1")
