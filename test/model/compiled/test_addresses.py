"""Kernels that are called by their address."""

from vehicle_roll_sim.model.compiled import jit
from vehicle_roll_sim.model.compiled.addresses import address_of, caller_of


def test_a_kernel_has_an_address_before_its_first_call():
    @jit.kernel
    def product(a, b):
        return a * b

    call = caller_of(product)
    address = address_of(product, (0.0, 0.0))

    @jit.kernel
    def doubled(address, a, b):
        return 2.0 * call(address, (a, b))

    assert doubled(address, 3.0, 0.5) == 3.0
