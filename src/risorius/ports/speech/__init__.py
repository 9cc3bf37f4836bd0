"""Speech as files: words, phones, visemes and sound."""
