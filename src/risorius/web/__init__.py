"""What servers share: who may speak to them, and where they listen."""
