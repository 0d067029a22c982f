"""Commands of the documentation that no test runs, and why."""

import re

INSTALLS = "installs packages or makes an environment"
TOOLS = "a tool of ROS 2 that the wheels of CI do not have"
WORKSPACE = "a workspace of the reader's"
NOT_RUN = {
    r"git clone ": "the address is the reader's",
    r"cd vehicle_roll_sim$": WORKSPACE,
    r"pipx run pre-commit ": INSTALLS,
    r"pip install ": INSTALLS,
    r"python3 -m venv ": INSTALLS,
    r"rosdep install ": INSTALLS,
    r"(python3? -m )?colcon (build|test|test-result)\b": "test/package builds a workspace",
    r"(source|\.) (\.venv|venv|roll)/bin/activate$": INSTALLS,
    r"touch venv/COLCON_IGNORE$": INSTALLS,
    r"(source|\.) (/opt/ros/\S+|install)/setup.bash$": WORKSPACE,
    r"test -f install/setup.bash$": WORKSPACE,
    r"cd ~/roll_ws$": WORKSPACE,
    r"rm -rf ~/.cache/vehicle_roll_sim$": "tests share the compiled model",
    r"ros2 bag\b": TOOLS,
    r"ros2 pkg executables": TOOLS,
    r"ros2 node list$": TOOLS,
    r"ros2 security ": TOOLS,
    r"ros2 run tf2_ros ": TOOLS,
    r"ros2 run plotjuggler ": "PlotJuggler is another package",
    r"ros2 run foxglove_bridge ": "Foxglove's bridge is another package",
    r"rviz2 ": "RViz is another package",
    r"ros2 run lqr_roll_bar_cpp ": "it is built with rclcpp, which the wheels of CI do not have",
    r"dask ssh ": "starts programs on other machines",
    r"vehicle_roll_sim study .* --dask ": "test/studies starts a cluster",
    r"vehicle_roll_sim view .* --(png|mp4|gif) ": "a browser is not installed everywhere",
    r"make ": "the target is looked up; CI runs lint, build, test and oldest",
    r"python -m benchmarks\.soak ": "takes hours; test/package runs it shortly",
}
"""Patterns of commands, as they are written, and the reason."""


def pattern_of(command: str) -> str | None:
    """The first pattern that a command matches."""
    return next((pattern for pattern in NOT_RUN if re.match(pattern, command)), None)
