"""Programs that run in an environment of their own: `sh benchmarks/peers/setup.sh`. They import nothing from here."""
