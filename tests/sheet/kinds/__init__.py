"""Stand-ins for kinds, so that the reports of wrong sheets do not change as kinds are added."""
