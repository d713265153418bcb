// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#ifdef YADE_VTK

#include <libdeflate.h>
#include <memory>
#include <vtkZLibDataCompressor.h>

namespace yade::vtkFiles {

/// Writes zlib's format, which all readers of VTK's files know, with libdeflate: in half of zlib's own time, to the same size. Files name the
/// base class, which reads them.
class FastZlib : public vtkZLibDataCompressor {
public:
	static FastZlib* New() { return makeFastZlib(); }

protected:
	FastZlib() : compressor_(libdeflate_alloc_compressor(1), &libdeflate_free_compressor) { } // 1: the fastest
	~FastZlib() override = default;

	std::size_t GetMaximumCompressionSpace(std::size_t size) override
	{
		return libdeflate_zlib_compress_bound(compressor_.get(), size);
	}
	/// \returns 0 where it fails, as VTK has it.
	std::size_t CompressBuffer(unsigned char const* data, std::size_t size, unsigned char* compressed, std::size_t space) override
	{
		return libdeflate_zlib_compress(compressor_.get(), data, size, compressed, space);
	}

private:
	std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor_;

	static FastZlib* makeFastZlib()
	{
		auto* const made = new FastZlib;
		made->InitializeObjectBase();
		return made;
	}
};

} // namespace yade::vtkFiles

#endif // YADE_VTK
