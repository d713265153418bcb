# SPDX-License-Identifier: GPL-2.0-or-later
"""Print version, features and precision of an installed YADE, one `NAME=value` a line, for cmake/Yade.cmake.

Usage: yadeConfig.py <YADE library folder>/py/yade/config.py

The file is executed alone: YADE's libraries are not loaded. It reads HOME and YADE_PREFIX (and may move an old
settings folder), so it gets an empty home and no prefix.
"""

import os
import runpy
import sys
import tempfile

with tempfile.TemporaryDirectory() as emptyHome:
	os.environ['HOME'] = emptyHome
	os.environ.pop('YADE_PREFIX', None)
	os.environ.pop('XDG_CONFIG_HOME', None)
	config = runpy.run_path(sys.argv[1])

print('VERSION=' + config['version'])
print('FEATURES=' + ';'.join(config['features']))
print('REAL_BIT=' + str(config['highPrecisionBits']))
print('REAL_DEC=' + str(config['highPrecisionDecimalPlaces']))
print('REAL_NAME=' + config['highPrecisionName'])
print('LIBRARY_PATH=' + config['libPATH'])
print('SOURCE_ROOT=' + config['sourceRoot'])
print('MPMATH=' + ('ON' if config['highPrecisionMpmath'] else 'OFF'))
