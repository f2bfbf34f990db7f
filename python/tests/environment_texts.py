"""Scenarios that several tests of environments use."""

SEVERAL = """import "std/academy/academy_3_vs_1_with_keeper.pitch"

scenario several extends academy_3_vs_1_with_keeper {
    agents { left: 3 right: 1 }
}
"""

SCRIPTED = """import "std/academy/academy_empty_goal_close.pitch"

scenario scripted extends academy_empty_goal_close {
    remove reward scoring
    reward script "mine.rhai"
}
"""
