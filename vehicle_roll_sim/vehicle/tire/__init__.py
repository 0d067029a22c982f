"""Reading tire property files: text, units, keys and their versions, signs, and stand-ins."""
