#!/usr/bin/env python3
"""Example controller: model-predictive rollover prevention by braking and rear steering.

Answers `motion` with `brake_torque_cmd` and `rear_steering_cmd`. The law is that of
vehicle_roll_sim.control_laws.rollover_mpc, which needs no ROS and can also be used in studies; the
vehicle of its prediction model is read from the simulator's parameters.
"""

from vehicle_roll_sim.controller import Controller, by_name, run  # isort: split

from vehicle_roll_sim.control_laws import rollover_mpc
from vehicle_roll_sim.ros.clients.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.clients.simulator_client import SimulatorClient


class RolloverMpc(Controller):
    node_name = "rollover_mpc"
    heard = ("motion",)
    said = ("brake_torque_cmd", "rear_steering_cmd")

    def __init__(self):
        super().__init__()
        self.simulator = self.declare_parameter("simulator", "simulator").value  # node name
        self.law = self.parameters_for(rollover_mpc.RolloverMpc)

    def prepare(self) -> None:
        simulator = SimulatorClient(self, self.executor, self.simulator)
        self.law.begin(*simulated_vehicle(simulator.get))

    def answer(self, motion) -> dict:
        answer = self.law.answer_to(by_name(motion))
        return {f"{name}_cmd": value for name, value in answer.items()}


def main() -> None:
    run(RolloverMpc)


if __name__ == "__main__":
    main()
