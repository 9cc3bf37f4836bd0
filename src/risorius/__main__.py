"""`python -m risorius` is the command line."""

from .cli import main

main()
