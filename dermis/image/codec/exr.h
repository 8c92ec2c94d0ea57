#pragma once
// Inside dermis/image only: what the EXR reader and writer share.

#include <ImfIO.h>

#include "dermis/image/codec/codec.h"

namespace dermis::inline image::codec {

/// Looks through the header by ourselves, because OpenEXR allocates by what a header says before anybody can
/// object: sizes, tiles, number of channels and the length of the chunk table must be such as this file can
/// hold.
[[nodiscard]] Result<void> check_exr_header(Bytes file);

/// A file in memory for OpenEXR to read. Reading past the end throws, as OpenEXR expects.
class ExrInput final : public Imf::IStream {
  public:
    explicit ExrInput(Bytes file) : Imf::IStream("memory"), file_(file) {}
    bool read(char to[], int count) override;
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t at) override { at_ = at; }

  private:
    Bytes file_;
    uint64_t at_ = 0;
};

/// A growing file in memory for OpenEXR to write, which goes back to fill in the chunk table.
class ExrOutput final : public Imf::OStream {
  public:
    ExrOutput() : Imf::OStream("memory") {}
    void write(const char from[], int count) override;
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t at) override { at_ = at; }
    [[nodiscard]] Buffer finish() { return std::move(bytes_); }

  private:
    Buffer bytes_;
    uint64_t at_ = 0;
};

}  // namespace dermis::inline image::codec
