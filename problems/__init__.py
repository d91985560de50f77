"""Worked problems: short scripts with a reference number each, and the exact solutions they compare with."""
