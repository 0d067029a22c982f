"""Codes of the standard `simulation_interfaces` of ROS 2, version 2.1.0, as far as they are used.

Source: github.com/ros-simulation/simulation_interfaces, messages SimulatorFeatures, Result and
SimulationState and services ResetSimulation, SetSimulationState and SetEntityState. 2.0.0 differs
only in that SetEntityState has no flags for what to set.
"""

import enum


class Feature(enum.IntEnum):
    """SimulatorFeatures: what this simulator supports."""

    ENTITY_STATE_GETTING = 10
    ENTITY_STATE_SETTING = 11
    SIMULATION_RESET = 20
    SIMULATION_STATE_GETTING = 24
    SIMULATION_STATE_SETTING = 25
    SIMULATION_STATE_PAUSE = 26
    STEP_SIMULATION_SINGLE = 31
    STEP_SIMULATION_MULTIPLE = 32
    STEP_SIMULATION_ACTION = 33


class Code(enum.IntEnum):
    """Result; from 101 on those of a single service."""

    FEATURE_UNSUPPORTED = 0
    OK = 1
    NOT_FOUND = 2
    INCORRECT_STATE = 3
    OPERATION_FAILED = 4
    ALREADY_IN_TARGET_STATE = 101
    STATE_TRANSITION_ERROR = 102
    INCORRECT_TRANSITION = 103


INVALID_POSE = 101
"""A code of SetEntityState."""


class State(enum.IntEnum):
    """SimulationState."""

    STOPPED = 0
    PLAYING = 1
    PAUSED = 2
    QUITTING = 3


class Scope(enum.IntFlag):
    """The scope of ResetSimulation; none is ALL."""

    TIME = 1
    STATE = 2
    SPAWNED = 4
    ALL = 255
