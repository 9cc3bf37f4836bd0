"""Types of the lips: articulators in millimetres, and the rig that performs them."""
