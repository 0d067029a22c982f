#!/usr/bin/env python3
"""Example controller: stability control (ESC) that brakes single wheels by yaw rate and roll.

Answers `motion` with `brake_torque_cmd`. The law, with its thresholds, is that of
vehicle_roll_sim.control_laws.stability_control, which needs no ROS and can also be used in studies;
wheelbase and understeer gradient of its reference are those of the simulator's vehicle.
"""

from vehicle_roll_sim.controller import Controller, by_name, run  # isort: split

from vehicle_roll_sim.control_laws import stability_control
from vehicle_roll_sim.ros.clients.simulated_vehicle import simulated_vehicle
from vehicle_roll_sim.ros.clients.simulator_client import SimulatorClient


class StabilityControl(Controller):
    node_name = "stability_control"
    heard = ("motion",)
    said = ("brake_torque_cmd",)

    def __init__(self):
        super().__init__()
        self.simulator = self.declare_parameter("simulator", "simulator").value  # node name
        self.law = self.parameters_for(stability_control.StabilityControl)

    def prepare(self) -> None:
        simulator = SimulatorClient(self, self.executor, self.simulator)
        self.law.begin(*simulated_vehicle(simulator.get))

    def answer(self, motion) -> tuple[float, ...]:
        return self.law.answer_to(by_name(motion))["brake_torque"]


def main() -> None:
    run(StabilityControl)


if __name__ == "__main__":
    main()
