# SPDX-License-Identifier: GPL-2.0-or-later
"""State of stress of a blocky rock mass: initial contact forces (`inSitu`) and what happens to them where blocks are taken away (`excavate`)."""
