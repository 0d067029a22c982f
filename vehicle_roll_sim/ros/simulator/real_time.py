"""Runs a simulator by the clock: one thread steps and publishes, another one answers.

Publishing from a loop that sleeps to absolute deadlines costs half of what a timer in the executor
does, and is on time more exactly (docs/performance.md).
"""

from concurrent.futures import ThreadPoolExecutor

from rclpy.executors import Executor

from vehicle_roll_sim.live.pacing import Pacer
from vehicle_roll_sim.model.integration.advance import NANOSECONDS

IDLE = 0.01
"""s between two looks at a simulator that is paused."""
MILLISECONDS = 1e3
"""In a second."""


class RealTime:
    """Periods of `period_ns` of simulated time, `factor` times as fast as time goes by.

    catch_up: the most that is made up for (s).
    """

    def __init__(self, period_ns: int, factor: float, catch_up: float):
        self.pacer, self._period = Pacer(period_ns, factor, catch_up), period_ns / NANOSECONDS
        self._overruns_told = 0

    def run(self, simulator, executor: Executor) -> None:
        """Until the context is shut down; raises what goes wrong in either thread."""
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
            self.pacer.sleep(self._period)  # the same state again need not come any faster
        self.pacer.wait()
        with simulator.lock:
            overruns = self.pacer.overruns
            if not simulator.session.paused and self.pacer.due():
                is_behind = self.pacer.overruns > overruns
                simulator.run_period(self.pacer.due_ns if is_behind else None)

    def restart(self) -> int:
        """At the start, after a reset or a pause: what was missed is not made up for.

        Returns the present by the steady clock (ns).
        """
        self.pacer.restart()
        return self.pacer.due_ns

    def timing(self) -> dict[str, str]:
        """Lateness of the periods since the last call, and those given up so far."""
        names = ("lateness p50 (ms)", "lateness p99 (ms)", "largest lateness (ms)")
        late = (f"{value * MILLISECONDS:.3f}" for value in self.pacer.lateness())
        return {**dict(zip(names, late, strict=True)), "overruns": str(self.pacer.overruns)}

    def trouble(self) -> str:
        """What went wrong since the last call, or ''."""
        given_up = self.pacer.overruns - self._overruns_told
        self._overruns_told = self.pacer.overruns
        return f"too slow a machine: {given_up} periods given up" if given_up else ""

    def waiting(self, _publishers) -> str:
        """Real time waits for nobody."""
        return ""
