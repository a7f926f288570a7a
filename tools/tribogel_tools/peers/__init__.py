"""The same scene in other programs, on the same meshes (`disc_mesh`)."""
