"""Vehicle data: the parameters, their files and the shipped presets."""
