"""Aerodynamic forces on the body: drag, side force and lift."""

from vehicle_roll_sim.model import records as at
from vehicle_roll_sim.model.compiled.jit import kernel, square_root
from vehicle_roll_sim.model.frames import ground_to_yawed, yawed_to_body
from vehicle_roll_sim.model.records import DV, DW, DWX, DWY, DWZ, LF, LR, RF


@kernel
def move_through_air(state, command, heading, attitude, outputs):
    """Velocity of the c.g. through air that moves with the wind, along x and y of frame 1 (m/s)."""
    ahead, left = ground_to_yawed(heading, command.wind[0], command.wind[1])
    x, y, _ = yawed_to_body(attitude, ahead, left, 0.0)
    outputs.air_velocity[0], outputs.air_velocity[1] = state[at.U] - x, state[at.V] - y


@kernel
def drag(u, vehicle):
    """Aerodynamic drag at the forward speed u through the air, acting at the c.g. (N)."""
    return vehicle.air_density / 2 * vehicle.drag_area * u * abs(u)


@kernel
def add_side_force_and_lift(vehicle, outputs):
    """Add side force and lift, in frame 1, to the forces on the body (N) and their moments (N m).

    With V the speed through the air along x and y and sin(beta) = v / V: side force -rho/2 A C V^2
    sin(beta), lift rho/2 A C V^2 on the centreline at each axle.
    """
    f, u, v = outputs.body_acceleration, outputs.air_velocity[0], outputs.air_velocity[1]
    square = u * u + v * v
    pressure = vehicle.air_density / 2
    side = -pressure * vehicle.side_force_area * square_root(square) * v
    front = pressure * vehicle.front_lift_area * square
    rear = pressure * vehicle.rear_lift_area * square
    f[DV] += side
    f[DW] += front + rear
    middle = (vehicle.y[LF] + vehicle.y[RF]) / 2
    f[DWX] += middle * (front + rear) - vehicle.pressure_centre_height * side
    f[DWY] -= vehicle.x[LF] * front + vehicle.x[LR] * rear
    f[DWZ] += vehicle.pressure_centre_ahead * side
