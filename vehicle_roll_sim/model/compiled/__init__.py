"""How the equations become machine code: the kernel decorator, its cache, fast mathematics."""
