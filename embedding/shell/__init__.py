"""The nonlinear shell: kinematics, hyperelastic laws, mechanical loads."""
