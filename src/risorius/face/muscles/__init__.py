"""What moves the skin: muscles, jaw and tongue."""
