"""The features of a road: as users give them, and as the equations take them."""
