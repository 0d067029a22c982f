"""The gymnasium environment of one vehicle."""

from collections.abc import Mapping
from typing import ClassVar

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded

from vehicle_roll_sim.learning.episodes import Episodes
from vehicle_roll_sim.learning.spaces import action_space, observation_space

EVERYONE = np.ones(1, bool)


class VehicleRollEnv(gymnasium.Env):
    """A vehicle that should stay on its wheels; `gymnasium.make("VehicleRoll-v0")` makes one.

    given: arguments of `Episodes` other than count and workers. An episode is terminated by a
    rollover. It is truncated at the end of the manoeuvre, or if the simulation stops for another
    reason. Raises InputError for what is not allowed.
    """

    metadata: ClassVar[dict] = {"render_modes": []}

    def __init__(self, *arguments, **given):
        self._episodes = Episodes(1, *arguments, workers=1, **given)
        self.action_space = action_space(self._episodes.actions)
        self.observation_space = observation_space(self._episodes.observer)

    @property
    def action_names(self) -> tuple[str, ...]:
        """The name of each number of an action."""
        return self._episodes.actions.elements

    @property
    def observation_names(self) -> tuple[str, ...]:
        """The name of each number of an observation."""
        return self._episodes.observer.elements

    def reset(self, *, seed: int | None = None, options: Mapping | None = None):
        """Begin an episode. options: values of factors in place of those drawn, by name.

        Returns the observation, shape (m,), and the info: `time` and `drawn`.
        """
        super().reset(seed=seed)
        info = self._episodes.begin(0, self.np_random, {} if options is None else options)
        return self._episodes.observe()[0], info

    def step(self, action):
        """Hold an action for one period.

        Returns observation, reward, terminated, truncated and info: `time`, and at the end of the
        episode `condition` and `metrics`.
        """
        if self._episodes.has_ended[0]:
            raise ResetNeeded("the episode has ended: call reset first")
        (reward,) = self._episodes.step(np.asarray(action)[np.newaxis], EVERYONE)
        info = {"time": float(self._episodes.times[0])}
        has_ended, rolled_over = self._episodes.has_ended[0], bool(self._episodes.rolled_over[0])
        if has_ended:
            info |= self._episodes.final_info(0)
        observation = self._episodes.observe()[0]
        return observation, float(reward), rolled_over, bool(has_ended) and not rolled_over, info

    def close(self) -> None:
        """End the threads of the episodes."""
        self._episodes.close()
