"""Studies of actuators: many cases of one scene each, with a closed form beside every number and a chart at the end."""
