"""The subcommands, with a description of each.

A subcommand is the function NAME_command in the module NAME, which is imported only when the
subcommand runs: `vehicle_roll_sim --help` imports none of them.
"""

COMMANDS = {
    "run": "Simulate a manoeuvre offline and print a summary.",
    "replay": "Simulate the runs in a bag again from their applied commands, and compare.",
    "series": "Run a standard's test series, or a search over entry speeds: table and verdict.",
    "plot": "Plot recorded runs in the standard figure.",
    "linearize": "Linearise the model about steady driving: trim state, A, B, C, D and poles.",
    "paper": "Reproduce Shim and Ghike (2007): figures, data, and a verdict on every claim.",
    "compile": "Compile the model ahead of time, once per version, so that no run has to wait.",
    "parameters": "Print a Markdown table of all vehicle parameters: value, unit, range, meaning.",
    "template": "Write a commented vehicle, tire or command file to start from.",
}
