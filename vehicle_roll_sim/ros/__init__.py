"""The model on ROS 2: nodes, messages, topics. Everything else works without it."""

import sys

if sys.argv[:1] == ["-m"]:  # `python -m vehicle_roll_sim.ros.NODE`, on its way to the module
    from vehicle_roll_sim import early_signals

    early_signals.end_node_at_once(even_ignored=False)
    from vehicle_roll_sim.ros import missing

    if not missing.is_ros_installed():
        sys.exit(missing.end_without_ros(missing.PACKAGE))
