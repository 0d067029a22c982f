"""Suspension: struts that carry the body, and links that guide the wheels."""
