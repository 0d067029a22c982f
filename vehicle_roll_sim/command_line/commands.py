"""The subcommands and what each does.

The module of a subcommand has its name, and the function NAME_command. It is imported when it runs:
`vehicle_roll_sim --help` imports none of them.
"""

COMMANDS = {
    "run": "Simulate a manoeuvre offline and print what happened.",
    "replay": "Simulate the runs in a bag again, on the commands that were applied, and compare.",
    "series": "Drive a standard's test series, or a range of speeds: a table and its verdict.",
    "plot": "Draw the standard figure of recorded runs.",
    "linearize": "Linearise the model about steady driving: A, B, C, D and the poles.",
    "paper": "Rerun Shim and Ghike (2007): figures, data, and a verdict on every claim.",
    "compile": "Compile the model now, once for this version, so that no first start waits for it.",
    "parameters": "Print every parameter of a vehicle in Markdown: value, unit, range, meaning.",
    "template": "Write a commented vehicle file, tire file or command file to start from.",
}
