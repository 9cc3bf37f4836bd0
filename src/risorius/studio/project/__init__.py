"""Sessions as files: projects, saving, the list of sessions, and exports."""
