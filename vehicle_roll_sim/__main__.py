"""`python -m vehicle_roll_sim`: the same as the command `vehicle_roll_sim`."""

import sys

from vehicle_roll_sim.command_line.entry import main

if __name__ == "__main__":
    sys.exit(main())
