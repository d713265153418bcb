// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/PolytopeCheckpoint.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <lib/serialization/ObjectIO.hpp>

#include <boost/filesystem.hpp>
#include <libdeflate.h>

#include <array>
#include <atomic>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>

namespace yade {

POLYTOPE_CLASSES((PolytopeCheckpoint));

namespace {

	/// What a signal's handler may write to: atomics without a lock.
	std::atomic<int>  noted { 0 };
	std::atomic<int>  postponed { 0 };
	std::atomic<bool> sentAgain { false };
	struct sigaction  former[2];
	constexpr int     watched[2] = { SIGTERM, SIGINT };
	static_assert(std::atomic<int>::is_always_lock_free, "a signal's handler must not wait for a lock");

	void note(int number)
	{
		if (!sentAgain.exchange(false)) noted = number;
		for (int k = 0; k < 2; ++k)
			if (watched[k] == number && former[k].sa_handler != SIG_DFL && former[k].sa_handler != SIG_IGN)
				former[k].sa_handler(number);
	}

	/// Waits until the disk has the file or folder; false if it cannot be written there.
	bool onDisk(const string& name)
	{
		const int file = open(name.c_str(), O_RDONLY);
		if (file < 0) return false;
		const bool done = fsync(file) == 0;
		close(file);
		return done;
	}

	/// The bodies without their lists of pairs, for as long as the object lives. YADE writes these lists with each body, pairs without a contact
	/// among them, and forgets them when it loads: InteractionContainer has the contacts once more, and makes the lists from them.
	class WithoutPairLists {
	public:
		explicit WithoutPairLists(Scene& scene) : scene_(scene), lists_(scene.bodies->size()) { exchange(); }
		~WithoutPairLists() { exchange(); }
		WithoutPairLists(const WithoutPairLists&)            = delete;
		WithoutPairLists& operator=(const WithoutPairLists&) = delete;

	private:
		Scene&                         scene_;
		std::vector<Body::MapId2IntrT> lists_;

		void exchange()
		{
			for (std::size_t k = 0; k < lists_.size(); ++k)
				if (const auto& body = (*scene_.bodies)[Body::id_t(k)]) body->intrs.swap(lists_[k]);
		}
	};

	/// Writes the scene. Omega::saveSimulation would not notice if the end of a file cannot be written, and would change what O.reload() loads.
	/// \returns whether the system has taken all of it
	bool writeScene(const string& name)
	{
		std::ofstream file(name, std::ios::binary | std::ios::trunc);
		if (!file) return false;
		const shared_ptr<Scene> scene = Omega::instance().getScene();
		try {
			const WithoutPairLists lists(*scene);
			ObjectIO::save<const shared_ptr<Scene>, boost::archive::binary_oarchive>(file, "scene", scene);
			file.close();
		} catch (const std::exception&) { // of the archive or the stream, when the system does not take their bytes
			return false;
		}
		return !file.fail();
	}

	/// Appends a mark and the CRC-32 of all that is in the file (checkpoints.py looks at them): the archive itself takes other bytes as they are.
	/// \returns whether the system has taken them
	bool appendChecksum(const string& name)
	{
		std::ifstream     written(name, std::ios::binary);
		std::vector<char> block(1 << 20);
		std::uint32_t     sum = libdeflate_crc32(0, nullptr, 0);
		while (written.read(block.data(), std::streamsize(block.size())) || written.gcount() > 0)
			sum = libdeflate_crc32(sum, block.data(), std::size_t(written.gcount()));
		if (!written.eof()) return false;
		std::array<char, 12> end { 'p', 'o', 'l', 'y', 't', 'o', 'p', 'e' };
		for (std::size_t k = 0; k < 4; ++k)
			end[8 + k] = char(sum >> (8 * k) & 0xff);
		std::ofstream file(name, std::ios::binary | std::ios::app);
		file.write(end.data(), end.size());
		file.close();
		return !file.fail();
	}

	/// The scene's counters as they will be at the end of this step, for as long as the object lives.
	class EndOfStep {
	public:
		explicit EndOfStep(Scene& scene)
		        : scene_(scene), iter_(scene.iter), stopAtIter_(scene.stopAtIter), subStep_(scene.subStep), time_(scene.time),
		          stopAtTime_(scene.stopAtTime)
		{
			++scene.iter;
			scene.time += scene.dt;
			scene.subStep    = -1;
			scene.stopAtIter = -1; // where this run ends is not where the one that continues it does
			scene.stopAtTime = -1;
		}
		~EndOfStep()
		{
			scene_.iter       = iter_;
			scene_.time       = time_;
			scene_.subStep    = subStep_;
			scene_.stopAtIter = stopAtIter_;
			scene_.stopAtTime = stopAtTime_;
		}
		EndOfStep(const EndOfStep&)            = delete;
		EndOfStep& operator=(const EndOfStep&) = delete;

	private:
		Scene&                      scene_;
		decltype(Scene::iter)       iter_;
		decltype(Scene::stopAtIter) stopAtIter_;
		int                         subStep_;
		Real                        time_, stopAtTime_;
	};

} // namespace

void PolytopeCheckpoint::watchSignals()
{
	for (int k = 0; k < 2; ++k) {
		struct sigaction now;
		sigaction(watched[k], nullptr, &now);
		if (now.sa_handler == note) continue;
		former[k]             = now;
		struct sigaction ours = now;
		ours.sa_handler       = note;
		ours.sa_flags &= ~SA_SIGINFO;
		sigaction(watched[k], &ours, nullptr);
	}
}

int PolytopeCheckpoint::notedSignal() { return noted; }

void PolytopeCheckpoint::postpone(int number) { postponed = number; }

bool PolytopeCheckpoint::isActivated()
{
	const bool due = PeriodicEngine::isActivated(); // counts
	return due || (onSignal && noted != 0);
}

void PolytopeCheckpoint::action()
{
	const int signal = onSignal ? noted.load() : 0;
	{
		const EndOfStep end(*scene);
		save();
	}
	if (signal == 0) return;
	noted             = 0;
	scene->stopAtIter = scene->iter + 1;
	const int later   = postponed.exchange(0);
	if (later == 0) return;
	sentAgain = true;
	std::raise(later);
}

void PolytopeCheckpoint::write()
{
	scene = Omega::instance().getScene().get();
	save();
	if (onSignal) noted = 0;
}

string PolytopeCheckpoint::nameOf(const char* state) const { return fileName + state + ".yade"; }

void PolytopeCheckpoint::notePermanentLoads()
{
	loaded.clear();
	permanentForces.clear();
	permanentTorques.clear();
	if (!scene->forces.getPermForceUsed()) return;
	scene->forces.sync(); // makes room for all bodies
	for (const auto& body : *scene->bodies) {
		if (!body) continue;
		const Vector3r force = scene->forces.getPermForce(body->getId()), torque = scene->forces.getPermTorque(body->getId());
		if (force == Vector3r::Zero() && torque == Vector3r::Zero()) continue;
		loaded.push_back(body->getId());
		permanentForces.push_back(force);
		permanentTorques.push_back(torque);
	}
}

void PolytopeCheckpoint::save()
{
	const auto folder = boost::filesystem::absolute(fileName).parent_path();
	boost::filesystem::create_directories(folder);
	const string writing = nameOf(".writing"), last = nameOf(""), previous = nameOf(".previous");
	notePermanentLoads();
	++written;
	if (!writeScene(writing) || !appendChecksum(writing) || !onDisk(writing))
		throw std::runtime_error("PolytopeCheckpoint.fileName: cannot write " + writing + "; is the disk full?");
	if (boost::filesystem::exists(last)) boost::filesystem::rename(last, previous);
	boost::filesystem::rename(writing, last);
	onDisk(folder.string()); // the names; a folder that cannot be synchronised has them all the same
}

} // namespace yade
