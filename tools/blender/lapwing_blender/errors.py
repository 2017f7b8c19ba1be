# SPDX-License-Identifier: GPL-3.0-or-later
"""The exceptions of the add-on."""


class Refusal(Exception):
    """One sentence for Blender's report: what is wrong, and the next step."""


class Cancelled(Exception):
    """The user pressed Esc."""
