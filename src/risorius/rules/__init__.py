"""The rules that a user can edit: strict tables of emotions, timing, gestures and lips, and their readers."""
