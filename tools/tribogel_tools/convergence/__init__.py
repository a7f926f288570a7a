"""Refinement of mesh and steps: what runs (`command`), families and limits (`refinement`), tables and picture
(`report`)."""
