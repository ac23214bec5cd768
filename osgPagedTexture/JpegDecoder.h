// SPDX-License-Identifier: MIT
#pragma once

#include <csetjmp>
#include <cstdio>
#include <string>
#include <vector>

#include <jpeglib.h>

namespace osgPagedTexture
{

/// A file that libjpeg reads piece by piece. It is open only meanwhile: a wall of photographs that
/// are read side by side needs more files than a process may have open.
class JpegFileInput
{
public:
    explicit JpegFileInput(const std::string& path);
    JpegFileInput(const JpegFileInput&) = delete;
    JpegFileInput& operator=(const JpegFileInput&) = delete;
    jpeg_source_mgr* source() { return &_source.base; }

private:
    struct Source
    {
        jpeg_source_mgr base; ///< First: libjpeg gives back a pointer to it.
        JpegFileInput* self;
    };
    static boolean fill(j_decompress_ptr jpeg);
    static void skip(j_decompress_ptr jpeg, long count);
    std::size_t readPiece();

    const std::string _path;
    Source _source{};
    std::vector<JOCTET> _piece;
    long _place = 0;
};

/// libjpeg behind functions that return false on an error and keep count of its warnings. Its
/// errors are jumps, so nothing with a destructor may live in the functions that call it.
class JpegDecoder
{
public:
    /// `bytes` must outlive it.
    explicit JpegDecoder(const std::string& bytes);
    /// `input` must outlive it.
    explicit JpegDecoder(JpegFileInput& input);
    ~JpegDecoder();
    JpegDecoder(const JpegDecoder&) = delete;
    JpegDecoder& operator=(const JpegDecoder&) = delete;

    bool readHeader();
    bool start();
    /// As start(), with the coefficients of all blocks read and held; null on an error. They live
    /// as long as the decoder, and until finish().
    jvirt_barray_ptr* startWithCoefficients();
    bool readRow(JSAMPROW row);
    /// Goes past rows, faster than reading them.
    bool skipRows(unsigned int count);
    bool finish(); ///< Reads on to the end marker: data that nobody asked for are a warning too.

    jpeg_decompress_struct& info() { return _info; }
    const jpeg_decompress_struct& info() const { return _info; }
    bool isWarned() const { return _errors.base.num_warnings > 0; }
    const char* getError() const { return _errors.error; }
    const char* getWarning() const { return _errors.warning; } ///< The first one.
    std::string getExif() const; ///< Data of the first APP1 segment that starts as EXIF does.

private:
    struct Errors
    {
        jpeg_error_mgr base; ///< First: libjpeg gives back a pointer to it.
        std::jmp_buf jump;
        char error[JMSG_LENGTH_MAX];
        char warning[JMSG_LENGTH_MAX];
    };
    static void fail(j_common_ptr info);
    static void note(j_common_ptr info, int level);
    static void watch(j_common_ptr info);

    void setUp();

    const std::string* _bytes = nullptr; ///< Or _input.
    JpegFileInput* _input = nullptr;
    Errors _errors{};
    jpeg_progress_mgr _progress{};
    jpeg_decompress_struct _info{};
};

} // namespace osgPagedTexture
