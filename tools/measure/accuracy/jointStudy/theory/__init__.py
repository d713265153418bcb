# SPDX-License-Identifier: GPL-2.0-or-later
"""Theory for the scenes: closed forms and limit analysis, without YADE."""
