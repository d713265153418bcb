# SPDX-License-Identifier: GPL-2.0-or-later
"""Loading tests on samples of polytopes (docs/loading.md): polytope.pack, triaxial, oedometer, simpleShear, shearBox."""
