// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {

/// Defines `WorkerContacts` in yade._polytope (for PythonModule.cpp).
void defineWorkerContacts();

} // namespace yade
