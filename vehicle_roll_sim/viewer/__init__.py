"""The page that shows runs in a browser: one HTML file that needs no network."""
