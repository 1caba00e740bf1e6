"""`python -m worker.cli` is `sldr`."""

from worker.cli import main

main()
