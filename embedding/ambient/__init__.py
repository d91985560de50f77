"""The field around the shell: its energy, its potential and jump, and the motion of its mesh."""
