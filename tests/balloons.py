"""Scene files of balloons so small that a solve is over at once."""

SMALL = """
name = "small balloon"

[shell]
thickness = "0.2 mm"
shape = { kind = "sphere", radius = "20 mm" }
material = { law = "neo-hookean", shear_modulus = "100 kPa" }

[loads]
pressure_bottom = "500 Pa"

[[path]]
name = "inflate"
steps = 2
"""
SMALLEST = SMALL.replace("steps = 2", "steps = 1") + """
[discretisation]
order = 2
"""
