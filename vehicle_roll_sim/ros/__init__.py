"""The ROS 2 side: nodes, QoS, parameters and launch support. Nothing else needs ROS 2."""

import sys

if sys.argv[:1] == ["-m"]:  # while `python -m vehicle_roll_sim.ros.NODE` looks for the module
    from vehicle_roll_sim import early_signals

    early_signals.end_node_at_once(even_ignored=False)
    from vehicle_roll_sim.ros import availability

    if not availability.is_ros_installed():
        sys.exit(availability.end_without_ros(availability.PACKAGE))
