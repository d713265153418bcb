// SPDX-License-Identifier: GPL-2.0-or-later
//
// libpolytope.so: what YADE loads at its start, because it lies in YADE's library folder.
//
// The classes of the plug-in are in a second library, polytope-py/_polytope.so, compiled with YADE's headers. Loaded into
// another YADE than it was compiled for, that one would end the process (an undefined symbol makes YADE abort) or corrupt
// its objects. This library needs nothing of YADE's C++ side, so it can be loaded anywhere. It
//
//   1. compares version, precision, features and Boost of the running YADE with those compiled against,
//   2. loads YADE's own libraries first (the order in which YADE finds its libraries is the file system's), then
//      _polytope.so, whose classes register themselves, and has it compare the layout of classes (LayoutCheck.hpp),
//   3. loads the extensions that others have written (Extensions.hpp), then
//   4. adds the folder polytope-py to yade.__path__: `from yade import polytope` finds the package there, and
//      `from yade import _polytope` the extension module in the same library (PythonModule.cpp).
//
// If 1 or 2 fails, YADE runs on without the plug-in: a warning says why, and so does the ImportError that
// `from yade import polytope` then raises.
#include <Python.h>

#include "BuildInfo.hpp"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace {

/// Owns one reference to a Python object; null where the call that made it failed (the Python error is cleared).
class Reference {
public:
	explicit Reference(PyObject* newReference) : object(newReference)
	{
		if (!object) PyErr_Clear();
	}
	Reference(const Reference&)            = delete;
	Reference& operator=(const Reference&) = delete;
	~Reference() { Py_XDECREF(object); }

	explicit  operator bool() const { return object; }
	PyObject* get() const { return object; }

private:
	PyObject* object;
};

/// Folder of this library: as YADE opened it, so for a symbolic link the folder of the link.
std::string ownFolder()
{
	Dl_info info;
	if (!dladdr(reinterpret_cast<void*>(&ownFolder), &info) || !info.dli_fname) return ".";
	const std::string file(info.dli_fname);
	const auto        slash = file.rfind('/');
	return slash == std::string::npos ? "." : file.substr(0, slash);
}

/// The text `yade.config.<name>`; a list of texts comes joined by blanks. Empty where it is not there.
std::string yadeConfig(const char* name)
{
	const Reference config(PyImport_ImportModule("yade.config"));
	if (!config) return "";
	const Reference value(PyObject_GetAttrString(config.get(), name));
	if (!value) return "";
	const Reference   blank(PyUnicode_FromString(" "));
	const Reference   joined(PyUnicode_Check(value.get()) ? Py_NewRef(value.get()) : PyUnicode_Join(blank.get(), value.get()));
	const char* const text = joined ? PyUnicode_AsUTF8(joined.get()) : nullptr;
	return text ? text : "";
}

/// In what the running YADE differs from the one the plug-in was compiled for; empty if in nothing.
std::string differenceFromBuild()
{
	using namespace polytope::buildInfo;
	const std::string version = yadeConfig("version");
	if (version != yadeVersion) return "it was compiled for YADE " + std::string(yadeVersion) + ", and this is YADE " + version;
	const std::string real = yadeConfig("highPrecisionName");
	if (real != realName)
		return "it was compiled for a YADE with numbers of the kind " + std::string(realName) + ", and this one has " + real;
	const std::string features = yadeConfig("features");
	if (features != yadeFeatures)
		return "it was compiled for a YADE with the features\n\t" + std::string(yadeFeatures) + "\nand this one has\n\t" + features;
	void* const boost = dlopen(POLYTOPE_BOOST_PYTHON, RTLD_LAZY | RTLD_NOLOAD);
	if (!boost) return "it was compiled with " + std::string(POLYTOPE_BOOST_PYTHON) + ", and this YADE uses another version";
	dlclose(boost);
	return "";
}

/// Loads the classes; returns the error, or an empty text.
std::string loadClasses(const std::string& folder)
{
	for (const char* library : polytope::buildInfo::yadeLibraries)
		if (!dlopen((folder + "/" + library).c_str(), RTLD_NOW | RTLD_GLOBAL)) return dlerror();

	void* const classes = dlopen((folder + "/polytope-py/_polytope.so").c_str(), RTLD_NOW | RTLD_GLOBAL);
	if (!classes) return dlerror();
	const auto checkLayout = reinterpret_cast<void (*)()>(dlsym(classes, "polytopeCheckLayout"));
	if (!checkLayout) return dlerror();
	checkLayout();
	return "";
}

/// The extensions (docs/extending.md) of the folder yade-polytope/<precision> beside YADE's library folder, in the order of their names,
/// and of the paths in YADE_POLYTOPE_EXTENSIONS. YADE itself looks into none of them. One that does not fit is left out, with a warning.
void loadExtensions(const std::string& folder)
{
	namespace files = std::filesystem;
	std::vector<std::string> paths;
	std::error_code          none;
	for (const auto& entry : files::directory_iterator(folder + "/../yade-polytope/" + polytope::buildInfo::precision, none))
		if (entry.path().extension() == ".so") paths.push_back(files::weakly_canonical(entry.path(), none).string());
	std::sort(paths.begin(), paths.end());
	const char* const  given = std::getenv("YADE_POLYTOPE_EXTENSIONS");
	std::istringstream list(given ? given : "");
	for (std::string path; std::getline(list, path, ':');)
		if (!path.empty()) paths.push_back(files::weakly_canonical(path, none).string());

	void* const classes = dlopen((folder + "/polytope-py/_polytope.so").c_str(), RTLD_NOW | RTLD_NOLOAD);
	const auto  load    = reinterpret_cast<const char* (*)(const char*)>(classes ? dlsym(classes, "polytopeLoadExtension") : nullptr);
	for (const std::string& path : paths) {
		const std::string fault = load ? load(path.c_str()) : "the plug-in cannot load it";
		if (!fault.empty()) std::cerr << "WARNING: the extension " << path << " is not loaded: " << fault << ".\n";
	}
}

void extendYadePath(const std::string& folder)
{
	const Reference yade(PyImport_ImportModule("yade"));
	const Reference path(yade ? PyObject_GetAttrString(yade.get(), "__path__") : nullptr);
	const Reference entry(PyUnicode_FromString(folder.c_str()));
	if (path && entry && PySequence_Contains(path.get(), entry.get()) == 0) PyList_Append(path.get(), entry.get());
	PyErr_Clear();
}

/// Makes `from yade import polytope` raise an ImportError with the reason.
void refuse(const std::string& reason)
{
	const char* const finder = R"(
class PolytopeNotLoaded:
	@staticmethod
	def find_spec(name, path=None, target=None):
		if name in ('yade.polytope', 'yade._polytope'): raise ImportError(reason, name=name)

import sys
sys.meta_path.insert(0, PolytopeNotLoaded)
print('WARNING:', reason, file=sys.stderr)
)";
	const Reference   scope(PyDict_New());
	const Reference   text(PyUnicode_FromString(reason.c_str()));
	PyDict_SetItemString(scope.get(), "__builtins__", PyEval_GetBuiltins());
	PyDict_SetItemString(scope.get(), "reason", text.get());
	const Reference done(PyRun_String(finder, Py_file_input, scope.get(), scope.get()));
}

__attribute__((constructor)) void loadPlugin()
{
	if (!Py_IsInitialized()) return;
	const PyGILState_STATE gil    = PyGILState_Ensure();
	const std::string      folder = ownFolder();
	std::string            fault  = differenceFromBuild();
	if (fault.empty()) fault = loadClasses(folder);
	if (fault.empty()) {
		loadExtensions(folder);
		extendYadePath(folder + "/polytope-py");
	} else refuse("the plug-in yade-polytope in " + folder + " is not loaded: " + fault + ".\n" + polytope::buildInfo::remedy);
	PyGILState_Release(gil);
}

} // namespace
