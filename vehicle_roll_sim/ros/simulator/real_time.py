"""Runs a simulator in real time: one thread steps and publishes, another runs the callbacks.

A loop that sleeps until absolute deadlines costs half as much as a timer in the executor, and is
more punctual (docs/performance.md).
"""

from concurrent.futures import ThreadPoolExecutor

from rclpy.executors import Executor

from vehicle_roll_sim.live.pacing import Pacer
from vehicle_roll_sim.model.integration.advance import NANOSECONDS

IDLE = 0.01
"""Poll interval (s) while the simulator is paused."""
MILLISECONDS = 1e3
"""Per second."""


class RealTime:
    """Runs periods of `period_ns` of simulated time at `factor` times real time.

    catch_up: largest delay (s) that is made up for; further periods are skipped.
    """

    def __init__(self, period_ns: int, factor: float, catch_up: float):
        self.pacer, self._period = Pacer(period_ns, factor, catch_up), period_ns / NANOSECONDS
        self._overruns_told = 0

    def run(self, simulator, executor: Executor) -> None:
        """Run until the context is shut down; raise any exception of either thread."""
        simulator.begin()
        with ThreadPoolExecutor(1, "answers") as pool:
            answers = pool.submit(executor.spin)
            try:
                while simulator.context.ok() and not answers.done():
                    self._go_on(simulator)
            finally:
                executor.shutdown()
        answers.result()

    def _go_on(self, simulator) -> None:
        if simulator.session.paused:
            self.pacer.sleep(IDLE)
            return
        if simulator.session.stopped and self.pacer.is_free:
            self.pacer.sleep(self._period)  # no need to repeat the same state any faster
        self.pacer.wait()
        with simulator.lock:
            overruns = self.pacer.overruns
            if not simulator.session.paused and self.pacer.due():
                is_behind = self.pacer.overruns > overruns
                simulator.run_period(self.pacer.due_ns if is_behind else None)

    def restart(self) -> int:
        """Start pacing afresh, as after a reset or a pause: missed periods are not made up for.

        Returns the current time of the steady clock (ns).
        """
        self.pacer.restart()
        return self.pacer.due_ns

    def timing(self) -> dict[str, str]:
        """Diagnostics: lateness of the periods since the last call, and periods skipped so far."""
        names = ("lateness p50 (ms)", "lateness p99 (ms)", "largest lateness (ms)")
        late = (f"{value * MILLISECONDS:.3f}" for value in self.pacer.lateness())
        return {**dict(zip(names, late, strict=True)), "overruns": str(self.pacer.overruns)}

    def trouble(self) -> str:
        """A warning if periods were skipped since the last call, else ''."""
        skipped = self.pacer.overruns - self._overruns_told
        self._overruns_told = self.pacer.overruns
        return f"the machine is too slow: {skipped} periods skipped" if skipped else ""

    def waiting(self, _publishers) -> str:
        """Always '': in real time, the simulator waits for nobody."""
        return ""
