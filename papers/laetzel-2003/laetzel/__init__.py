"""Lätzel (2003) redone with crossgrain: README.md beside this folder has the words and how to begin."""
