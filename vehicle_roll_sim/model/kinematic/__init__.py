"""Model 2: wheels that are guided along paths, with the roll centre as a kinematic link."""
