// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/Extensions.hpp"

#include "host/ExtensionTrial.hpp"

#include <core/Aabb.hpp>
#include <core/Omega.hpp>
#include <lib/factory/ClassFactory.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/NormShearPhys.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <src/joint/ClosureLaw.hpp>

#include "BuildInfo.hpp"
#include <polytope/config.hpp>
#include <yade-polytope/Fingerprint.hpp>

#include <algorithm>
#include <cstring>
#include <dlfcn.h>
#include <elf.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <list>
#include <map>
#include <sstream>
#include <stdexcept>

namespace yade {

namespace {

	using Names = std::list<std::string>;

	std::deque<Extension>& loaded()
	{
		static std::deque<Extension> all; // a pointer to one stays right when another is added
		return all;
	}

	std::string contentOf(const std::string& path)
	{
		std::error_code none;
		if (std::filesystem::is_directory(path, none))
			throw std::runtime_error("it is a folder; give the path of the library in it");
		if (!std::filesystem::exists(path, none)) throw std::runtime_error("there is no such file; build the extension first");
		std::ifstream file(path, std::ios::binary);
		std::string   bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
		if (!file.is_open() || file.bad()) throw std::runtime_error("its file cannot be read");
		return bytes;
	}

	/// Where a library ends before the table of its sections, which is its last part. The dynamic linker does not ask: it maps what is not
	/// there into memory, and the process ends where it reads that.
	void refusePart(const std::string& bytes)
	{
		Elf64_Ehdr head;
		if (bytes.size() < sizeof(head)) return;
		std::memcpy(&head, bytes.data(), sizeof(head));
		if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_ident[EI_CLASS] != ELFCLASS64) return;
		const std::size_t end = head.e_shoff + std::size_t(head.e_shentsize) * head.e_shnum;
		if (bytes.size() < end)
			throw std::runtime_error("its file is cut off: it has " + std::to_string(bytes.size()) + " of "
			        + std::to_string(end) + " bytes; copy it or build it again");
	}

	/// NAME=VALUE lines of the text that the library has about itself; empty if it has none.
	std::map<std::string, std::string> ownText(const std::string& bytes)
	{
		refusePart(bytes);
		std::map<std::string, std::string> values;
		const std::string                  mark  = std::string("yade-polytope-") + "extension\n"; // in two: this library is none
		const std::size_t                  start = bytes.find(mark);
		if (start == std::string::npos) return values;
		std::istringstream text(bytes.substr(start + mark.size(), bytes.find('\0', start) - start - mark.size()));
		for (std::string line; std::getline(text, line);) {
			const std::size_t equals = line.find('=');
			if (equals != std::string::npos) values[line.substr(0, equals)] = line.substr(equals + 1);
		}
		return values;
	}

	/// Why a library that says this of itself does not fit; empty if it does.
	std::string misfit(std::map<std::string, std::string> own)
	{
		namespace info = polytope::buildInfo;
		if (own.empty())
			return "it is no extension of yade-polytope: build it by yade_polytope_add_extension() of "
			       "find_package(yade-polytope)";
		const std::string again = "; build it again with this yade-polytope";
		if (own["precision"] != info::precision)
			return "it was built for the precision " + own["precision"] + ", and this YADE computes in " + info::precision
			        + again;
		if (own["yade"] != info::yadeVersion)
			return "it was built for YADE " + own["yade"] + ", and this is YADE " + info::yadeVersion + again;
		if (own["features"] != info::yadeFeatures) return "it was built for a YADE with the features " + own["features"] + again;
		if (own["abi"] != std::to_string(POLYTOPE_ABI))
			return "it was built for the binary interface " + own["abi"] + " of yade-polytope, and this one has "
			        + std::to_string(POLYTOPE_ABI) + again;
		if (own["headers"] != YADE_POLYTOPE_FINGERPRINT)
			return "it was built for yade-polytope " + own["version"] + " with other headers than those of this one ("
			        + info::version + ")" + again;
		return "";
	}

	/// Whether the object has its class index from the counter that all others of its kind have.
	template <class Kind> bool sharesCounter(Factorable* object, const Kind& known)
	{
		const auto* const own = dynamic_cast<const Kind*>(object);
		return !own || &own->getMaxCurrentlyUsedClassIndexOfKin() == &known.getMaxCurrentlyUsedClassIndexOfKin();
	}

	/// What is wrong with the new classes; empty if nothing is.
	std::string faultOf(const Names& classes, const Names& known)
	{
		if (classes.empty()) return "it has no class: YADE_PLUGIN((Class)…) in one of its files makes classes known";
		for (const std::string& name : classes) {
			if (std::find(known.begin(), known.end(), name) != known.end()) return "there is a class " + name + " already";
			const auto object = ClassFactory::instance().createShared(name);
			if (!sharesCounter<Shape>(object.get(), Sphere()) || !sharesCounter<Bound>(object.get(), Aabb())
			        || !sharesCounter<Material>(object.get(), ElastMat()) || !sharesCounter<IGeom>(object.get(), ScGeom())
			        || !sharesCounter<IPhys>(object.get(), NormShearPhys()) || !sharesCounter<State>(object.get(), State()))
				return name
				        + " has the class index of another class, since it was compiled with hidden visibility: build it "
				          "without "
				          "-fvisibility=hidden, as yade_polytope_add_extension() does";
		}
		return "";
	}

	/// What is wrong with the normal laws that were made after the first so many; empty if nothing is.
	std::string faultOfLaws(std::size_t before)
	{
		const auto& all = polytope::NormalLaw::all();
		for (std::size_t k = before; k < all.size(); ++k)
			if (const std::string fault = all[k]->fault(); !fault.empty()) return fault;
		return "";
	}

	struct Refused {
		std::size_t content; ///< sum over the file
		std::string reason;
	};

	/// Libraries that were refused after they had been loaded, by their paths: they stay in the process, and YADE's factory keeps their
	/// classes. What was refused before that, as on trial, is looked at anew.
	std::map<std::string, Refused>& staying()
	{
		static std::map<std::string, Refused> all;
		return all;
	}

	/// Makes the library's classes known to YADE's factory, and its normal laws by their names; where they are refused they are taken out of
	/// those lists again.
	Extension opened(const std::string& path, const std::string& name, std::size_t content)
	{
		if (const std::string fault = faultOfConstructors(path); !fault.empty()) throw std::runtime_error(fault);
		Names& all  = ClassFactory::instance().pluginClasses;
		auto&  laws = polytope::NormalLaw::all();
		Names  known;
		known.swap(all);
		const std::size_t before  = laws.size();
		void* const       library = dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
		Names             classes;
		classes.swap(all);
		all.swap(known);
		std::string fault = library ? faultOf(classes, all) : dlerror();
		if (fault.empty()) fault = faultOfLaws(before);
		if (fault.empty()) return { path, name, { classes.begin(), classes.end() } };
		laws.resize(before);
		if (library) staying()[path] = { content, fault };
		throw std::runtime_error(fault);
	}

	/// What was not loaded before this is.
	Extension& add(const std::string& path)
	{
		const std::string bytes   = contentOf(path);
		const std::size_t content = std::hash<std::string>()(bytes);
		if (const auto found = staying().find(path); found != staying().end()) {
			const Refused& before = found->second;
			throw std::runtime_error(before.content == content
			                ? before.reason
			                : "it was built anew after it was refused, and what was refused stays in this process; start YADE "
			                  "again to load it (the reason was: "
			                        + before.reason + ")");
		}
		std::map<std::string, std::string> own   = ownText(bytes);
		const std::string                  fault = misfit(own);
		if (!fault.empty()) throw std::runtime_error(fault);
		loaded().push_back(opened(path, own["name"], content));
		return loaded().back();
	}

	const Extension* known(const std::string& path)
	{
		for (const Extension& one : loaded())
			if (one.path == path) return &one;
		return nullptr;
	}

} // namespace

const std::deque<Extension>& extensions() { return loaded(); }

const Extension& loadExtension(const std::string& path)
{
	if (const Extension* const before = known(path)) return *before;
	Extension& extension = add(path);
	// YADE registers all classes of this list with Python: for a moment the new ones alone
	Names& all = ClassFactory::instance().pluginClasses;
	Names  own(extension.classes.begin(), extension.classes.end());
	all.swap(own);
	Omega::instance().loadPlugins({});
	all.swap(own);
	all.insert(all.end(), extension.classes.begin(), extension.classes.end());
	return extension;
}

} // namespace yade

/// Called by Plugin.cpp when YADE starts, which registers the classes of all libraries with Python after this. An empty text, or what to
/// tell the user.
extern "C" __attribute__((visibility("default"))) const char* polytopeLoadExtension(const char* path)
{
	static std::string answer;
	answer.clear();
	try {
		if (yade::known(path)) return "";
		yade::Extension& extension = yade::add(path);
		auto&            all       = yade::ClassFactory::instance().pluginClasses;
		all.insert(all.end(), extension.classes.begin(), extension.classes.end());
	} catch (const std::exception& error) {
		answer = error.what();
	}
	return answer.c_str();
}
