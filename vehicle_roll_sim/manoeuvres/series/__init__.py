"""Test series: one manoeuvre driven again and again, and the verdict."""
