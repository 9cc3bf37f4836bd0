"""Parts that servers share: their addresses, and the check of who may speak to them."""
