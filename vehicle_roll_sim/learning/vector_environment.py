"""The gymnasium environment of many vehicles, stepped together by compiled code."""

from collections.abc import Mapping, Sequence

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from vehicle_roll_sim.declaration import InputError
from vehicle_roll_sim.learning.episodes import Episodes
from vehicle_roll_sim.learning.names import mapping_of
from vehicle_roll_sim.learning.scenario import EXAMPLE
from vehicle_roll_sim.learning.spaces import action_space, observation_space

MASK = "reset_mask"
"""Option of `reset`: which environments are reset, a boolean array of shape (n,)."""


class VehicleRollVectorEnv(VectorEnv):
    """Many independent `VehicleRollEnv`; `gymnasium.make_vec("VehicleRoll-v0")` makes one.

    Each equals a single environment with the same seed to the bit. num_envs: their number.
    autoreset_mode: when an environment whose episode has ended begins the next one:
    NextStep (the next call of `step` resets it and ignores its action), SameStep, or Disabled.
    workers: number of threads, by default one for each processor. given: further arguments of
    `Episodes`. Raises InputError for what is not allowed.
    """

    _episodes: Episodes | None = None

    def __init__(
        self,
        num_envs: int = 1,
        *arguments,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        **given,
    ):
        if isinstance(num_envs, bool) or not isinstance(num_envs, int) or num_envs < 1:
            raise InputError("num_envs", num_envs, "a whole number of at least 1")
        try:
            self._mode = AutoresetMode(autoreset_mode)
        except ValueError:
            allowed = "one of " + ", ".join(mode.value for mode in AutoresetMode)
            raise InputError("autoreset_mode", autoreset_mode, allowed) from None
        self._episodes = Episodes(num_envs, *arguments, **given)
        self.num_envs, self.metadata = num_envs, {"autoreset_mode": self._mode, "render_modes": []}
        self.single_action_space = action_space(self._episodes.actions)
        self.single_observation_space = observation_space(self._episodes.observer)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._generators: list[np.random.Generator | None] = [None] * num_envs

    @property
    def action_names(self) -> tuple[str, ...]:
        """The name of each number of an action."""
        return self._episodes.actions.elements

    @property
    def observation_names(self) -> tuple[str, ...]:
        """The name of each number of an observation."""
        return self._episodes.observer.elements

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: Mapping | None = None,
    ):
        """Begin episodes.

        seed: of the first environment, increased by 1 for each further one; or a list of seeds.
        options: values of factors, as for `VehicleRollEnv.reset`, and `reset_mask`. Returns the
        observations, shape (n, m), and the infos.
        """
        seeds = self._seeds(seed)
        chosen = mapping_of("options", {} if options is None else options, EXAMPLE)
        mask = self._mask(chosen.pop(MASK, None))
        if not mask.all() and None in self._generators:
            raise InputError(MASK, mask, "not in the first reset, which is of all environments")
        infos = {}
        for i in np.flatnonzero(mask):
            if seeds[i] is not None or self._generators[i] is None:
                self._generators[i], _ = seeding.np_random(seeds[i])
            infos = self._add_info(infos, self._begin(i, chosen), i)
        return self._episodes.observe(), infos

    def _seeds(self, seed) -> list[int | None]:
        if seed is None:
            return [None] * self.num_envs
        if isinstance(seed, int | np.integer):
            return [int(seed) + i for i in range(self.num_envs)]
        if not isinstance(seed, Sequence) or isinstance(seed, str) or len(seed) != self.num_envs:
            raise InputError("seed", seed, f"a whole number, or a list of {self.num_envs} of them")
        return list(seed)

    def _mask(self, mask) -> np.ndarray:
        if mask is None:
            return np.ones(self.num_envs, bool)
        is_mask = isinstance(mask, np.ndarray) and mask.dtype == bool
        if not is_mask or mask.shape != (self.num_envs,) or not mask.any():
            allowed = f"a boolean array of shape ({self.num_envs},), not all false"
            raise InputError(MASK, mask, allowed)
        return mask

    def _begin(self, i: int, chosen: Mapping) -> dict:
        return self._episodes.begin(i, self._generators[i], chosen)

    def step(self, actions):
        """Hold an action in each environment for one period, shape (n, k).

        Returns observations, rewards, terminations, truncations, and infos: `time`, `condition` and
        `metrics` where an episode has ended, and `drawn` where one begins.
        """
        if None in self._generators:
            raise ResetNeeded("call reset first")
        resetting = self._episodes.has_ended.copy()
        if self._mode is not AutoresetMode.NEXT_STEP and resetting.any():
            allowed = f"only after a reset with {MASK}"
            problem = f"the episodes {np.flatnonzero(resetting).tolist()} have ended"
            raise InputError("step", "", allowed, problem)
        rewards = self._episodes.step(actions, ~resetting)
        ended = self._episodes.has_ended & ~resetting
        terminated = self._episodes.rolled_over.copy()
        truncated = ended & ~terminated
        infos = {"time": self._episodes.times.copy(), "_time": np.ones(self.num_envs, bool)}
        observations = self._episodes.observe()
        for i in np.flatnonzero(ended):
            infos = self._add_final(infos, observations[i], i)
        beginning = ended if self._mode is AutoresetMode.SAME_STEP else resetting
        for i in np.flatnonzero(beginning):
            infos = self._add_info(infos, self._begin(i, {}), i)
        if beginning.any() and self._mode is not AutoresetMode.DISABLED:
            observations = self._episodes.observe()
        return observations, rewards, terminated, truncated, infos

    def _add_final(self, infos: dict, observation: np.ndarray, i: int) -> dict:
        final = self._episodes.final_info(i)
        if self._mode is not AutoresetMode.SAME_STEP:
            return self._add_info(infos, final, i)
        final = {"time": float(self._episodes.times[i]), **final}
        return self._add_info(infos, {"final_obs": observation.copy(), "final_info": final}, i)

    def close_extras(self, **_) -> None:
        """End the threads, if there are any yet."""
        if self._episodes is not None:
            self._episodes.close()
