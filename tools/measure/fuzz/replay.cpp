// SPDX-License-Identifier: GPL-2.0-or-later
//
// Runs a fuzz target over inputs without a fuzzer, with any compiler.
//
//   replay [--mutations N] FILE…         runs them all, then N random changes of them
//   replay --unpack FOLDER FILE.corpus   writes each input of a corpus as a file of its own
//   replay --pack FOLDER                 prints these as a corpus
//
// A corpus is text: an input a line, in hexadecimal; # begins a comment. Other files are one input each.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using Input  = std::vector<std::uint8_t>;

std::vector<Input> read(const std::string& path)
{
	std::ifstream file(path, std::ios::binary);
	if (!file) {
		std::cerr << path << ": cannot be read\n";
		std::exit(2);
	}
	if (fs::path(path).extension() != ".corpus") return { Input(std::istreambuf_iterator<char>(file), {}) };
	std::vector<Input> inputs;
	for (std::string line; std::getline(file, line);) {
		line = line.substr(0, line.find_first_of("# "));
		if (line.empty()) continue;
		Input input;
		for (std::size_t k = 0; k + 1 < line.size(); k += 2)
			input.push_back(std::uint8_t(std::stoi(line.substr(k, 2), nullptr, 16)));
		inputs.push_back(input);
	}
	return inputs;
}

std::string hexadecimal(const Input& input)
{
	std::string text;
	char        two[3];
	for (std::uint8_t byte : input) {
		std::snprintf(two, sizeof two, "%02x", byte);
		text += two;
	}
	return text;
}

Input current;

/// A violation refers to the input that was run last.
void printCurrent(int)
{
	std::cerr << "the input, as a line of a corpus:\n" << hexadecimal(current) << std::endl;
	std::_Exit(1);
}

void run(const Input& input)
{
	current = input;
	LLVMFuzzerTestOneInput(current.data(), current.size());
}

/// Some bytes changed, put in or taken out, or the end of another input.
Input mutated(Input input, const std::vector<Input>& others, std::mt19937_64& random)
{
	for (int changes = 1 + int(random() % 4); changes > 0; --changes) {
		const std::size_t at = input.empty() ? 0 : random() % input.size();
		switch (random() % 4) {
			case 0: input.insert(input.begin() + std::ptrdiff_t(at), std::uint8_t(random())); break;
			case 1:
				if (!input.empty()) input.erase(input.begin() + std::ptrdiff_t(at));
				break;
			case 2:
				if (!input.empty()) input[at] = std::uint8_t(random());
				break;
			default: {
				const Input& other = others[random() % others.size()];
				input.resize(at);
				input.insert(input.end(), other.begin() + std::ptrdiff_t(std::min(at, other.size())), other.end());
			}
		}
	}
	return input;
}

} // namespace

int main(int count, char** arguments)
{
	std::vector<std::string> words(arguments + 1, arguments + count);
	const bool               option = words.size() >= 2 && words[0].rfind("--", 0) == 0;
	if (option && words[0] == "--pack") {
		std::vector<std::string> lines;
		for (const auto& entry : fs::directory_iterator(words[1]))
			lines.push_back(hexadecimal(read(entry.path()).front()));
		std::sort(lines.begin(), lines.end());
		for (const std::string& line : lines)
			std::cout << line << '\n';
		return 0;
	}
	std::vector<Input> inputs;
	for (std::size_t k = option ? 2 : 0; k < words.size(); ++k)
		for (Input& input : read(words[k]))
			inputs.push_back(input);
	if (inputs.empty()) {
		std::cerr << "no inputs\n";
		return 2;
	}
	if (option && words[0] == "--unpack") {
		fs::create_directories(words[1]);
		for (std::size_t k = 0; k < inputs.size(); ++k)
			std::ofstream(fs::path(words[1]) / ("seed" + std::to_string(k)), std::ios::binary)
			        .write(reinterpret_cast<const char*>(inputs[k].data()), std::streamsize(inputs[k].size()));
		return 0;
	}
	long changed = 0;
	if (option && words[0] == "--mutations") changed = std::stol(words[1]);
	std::signal(SIGILL, printCurrent); // a violation
	std::signal(SIGABRT, printCurrent);
	for (const Input& input : inputs)
		run(input);
	std::mt19937_64 random(1);
	for (long k = 0; k < changed; ++k)
		run(mutated(inputs[random() % inputs.size()], inputs, random));
	std::cout << inputs.size() << " inputs and " << changed << " changes of them: sound\n";
	return 0;
}
