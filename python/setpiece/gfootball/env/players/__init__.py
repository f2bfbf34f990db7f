"""The players that a definition can name; each module has a class `Player`."""
