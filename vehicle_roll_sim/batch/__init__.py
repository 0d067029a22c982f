"""Many runs together: cases, their outcomes, and the threads that drive them."""
