"""Files written and read: one module for each format. Importing the package imports none of them."""
