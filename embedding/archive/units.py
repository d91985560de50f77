"""Units of the scalars that a step records, by name; a plane-strain run counts everything per length of
cylinder."""

from __future__ import annotations

UNITS = {
    "pressure_top": "Pa",
    "pressure_bottom": "Pa",
    "pressure_difference": "Pa",
    "min_principal_stress": "Pa",
    "voltage": "V",
    "displacement": "m",
}
EXTENSIVE = {
    "charge": "C",
    "field_energy": "J",
    "elastic_energy": "J",
    "force_x": "N",
    "force_y": "N",
    "force_z": "N",
    "held_force": "N",
}


def scalar_unit(name: str, per_length: bool = False) -> str:
    """SI unit of the scalar ``name``; "1" if it has none or the name is not known.

    ``per_length`` says that extensive quantities (charge, energy, force) are those of a metre of cylinder.
    """
    if name in EXTENSIVE:
        return f"{EXTENSIVE[name]}/m" if per_length else EXTENSIVE[name]
    return UNITS.get(name, "1")
