"""What is held at a potential or carries a charge: the electrodes of the shell, and conductors beside it.

All numbers are dimensionless and hold at full load. Which of the two faces carries ``phi`` itself (the *base*) and
which one the jump on top of it, follows from what is prescribed:

==========================  ==============================  ===============================
electrodes                  phi on the shell                jump
==========================  ==============================  ===============================
none                        free                            free, lifts the outside
one conductor               one value                       absent
bottom only                 one value                       free, lifts the outside
top only                    one value                       free, lifts the inside
both                        one value, that of the bottom   one value, lifts the outside
both, only the top's        one value, that of the top      one value, lifts the inside
voltage given
==========================  ==============================  ===============================

"One value" is prescribed where the voltage is given, and unknown where the charge is.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Source:
    """A conductor at a ``voltage``, or with a ``charge``; just one of them is given."""

    voltage: float | None = None
    charge: float | None = None

    @property
    def strength(self) -> float:
        """The number that is given."""
        return (self.voltage if self.voltage is not None else self.charge) or 0.0


@dataclass(frozen=True)
class Electrodes:
    """Conductors on the faces of the shell; None where a face is bare. ``joined``: both faces are one conductor, whose
    source is ``top``. ``where`` names the faces of a surface from a file that they cover; empty: all of it."""

    top: Source | None = None
    bottom: Source | None = None
    joined: bool = False
    where: tuple[str, ...] = ()

    @property
    def one_conductor(self) -> bool:
        """Are both faces at one potential all over the shell?"""
        if self.joined or self.where:
            return self.joined
        voltages = [source.voltage if source is not None else None for source in (self.top, self.bottom)]
        return voltages[0] is not None and voltages[0] == voltages[1]

    @property
    def jump_exists(self) -> bool:
        """Does the potential jump across the shell?"""
        return not self.one_conductor

    @property
    def lifted(self) -> str:
        """The side whose potential is phi + jump."""
        return "inside" if self._base_is_top else "outside"

    @property
    def base(self) -> Source | None:
        """The electrode whose potential is phi on the shell."""
        return self.top if self.joined or self._base_is_top else self.bottom

    @property
    def other(self) -> Source | None:
        """The electrode whose potential is phi + jump; None without a jump."""
        if self.one_conductor:
            return None
        return self.bottom if self._base_is_top else self.top

    @property
    def jump(self) -> float | None:
        """The jump of the lifted side's potential over the base's, where both voltages are given."""
        if self.base is None or self.other is None or self.other.voltage is None or self.base.voltage is None:
            return None
        return self.other.voltage - self.base.voltage

    @property
    def _base_is_top(self) -> bool:
        if self.joined or self.top is None:
            return False
        return self.bottom is None or (self.bottom.voltage is None and self.top.voltage is not None)
