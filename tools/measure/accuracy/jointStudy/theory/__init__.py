# SPDX-License-Identifier: GPL-2.0-or-later
"""What the scenes must answer: closed forms and limit analysis, without YADE."""
