"""What the analyses say of bodies, against runs of these."""
