"""The subcommands and what each does.

The module of a subcommand has its name, and the function NAME_command. It is imported when it runs:
`vehicle_roll_sim --help` imports none of them.
"""

COMMANDS = {
    "run": "Simulate a manoeuvre offline and print a summary.",
    "replay": "Simulate the runs in a bag again from their applied commands, and compare.",
    "series": "Run a test series of a standard or a search over entry speeds: table and verdict.",
    "study": "Run a study: many runs over varied values, with tables, probabilities and figures.",
    "score": "Score controllers in lockstep over a catalogue of tests (needs ROS 2): report.",
    "compare": "Compare a measured log with the model that is driven by it: errors and verdict.",
    "identify": "Identify values of a vehicle from measured logs: intervals and a vehicle file.",
    "plot": "Plot recorded runs in the standard figure.",
    "view": "Write a page that shows recorded runs in a browser: vehicle in 3D, plots and events.",
    "vehicle": "Show the contents of a vehicle file and what follows from it: figures and modes.",
    "vehicles": "List the vehicles that come with the package, with their figures.",
    "tire": "Show the contents of a tire file and how the tire behaves: table, figure, points.",
    "linearize": "Linearise the model about steady driving: trim state, A, B, C, D and poles.",
    "paper": "Reproduce Shim and Ghike (2007): figures, data, and a verdict on every claim.",
    "compile": "Compile the model ahead of time, once per version, so that no run has to wait.",
    "parameters": "Print all vehicle parameters as a Markdown table: value, unit, range, meaning.",
    "template": "Write a commented vehicle, tire or command file to start from.",
}
