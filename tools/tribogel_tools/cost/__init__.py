"""What runs cost: CPU seconds against error (`speed_against_error`), solvers (`compare_solvers`), dofs and
ranks (`scaling`)."""
