// SPDX-License-Identifier: MIT
#include <osgLabels/CsvRecords.h>

#include <csv.h>

#include <algorithm>
#include <cctype>

namespace osgLabels
{

namespace
{

/// What libcsv reports, one record at a time.
class Reader
{
public:
    explicit Reader(const std::function<bool(CsvRecord&)>& take) : _take(take) { start(); }
    ~Reader() { csv_free(&_parser); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    bool isAsking() const { return _isAsking; }
    std::size_t getLine() const { return _record.line; }

    /// False where the line breaks the rules; what follows it is read anew.
    bool read(const char* text, std::size_t size, std::size_t line)
    {
        if (!_record.line &&
            std::any_of(text, text + size, [](char c) { return c != '\r' && c != '\n'; }))
            _record.line = line;
        if (csv_parse(&_parser, text, size, field, record, this) == size)
            return true;
        csv_free(&_parser);
        start();
        _record = {};
        return false;
    }

    /// False where a quote is open.
    bool finish() { return csv_fini(&_parser, field, record, this) == 0; }

private:
    void start()
    {
        csv_init(&_parser, CSV_STRICT | CSV_STRICT_FINI);
        csv_set_space_func(&_parser, [](unsigned char) { return 0; }); // spaces are part of a field
    }
    static void field(void* data, std::size_t size, void* self)
    {
        static_cast<Reader*>(self)->_record.fields.emplace_back(static_cast<const char*>(data),
                                                                size);
    }
    static void record(int, void* data)
    {
        Reader& self = *static_cast<Reader*>(data);
        self._isAsking = self._isAsking && self._take(self._record);
        self._record = {};
    }

    const std::function<bool(CsvRecord&)>& _take;
    csv_parser _parser;
    CsvRecord _record;
    bool _isAsking = true;
};

} // namespace

void readCsv(const std::string& content, const std::function<bool(CsvRecord&)>& take,
             const std::function<bool(std::size_t, const std::string&)>& fail)
{
    Reader reader(take);
    std::size_t line = 1;
    // Line by line, so that the number of each is known.
    for (std::size_t at = 0; at < content.size(); ++line)
    {
        const std::size_t end = std::min(content.find('\n', at), content.size() - 1) + 1;
        if (!reader.read(content.data() + at, end - at, line) &&
            !fail(line, "a quote inside of a field; double it, and quote the field: "
                        "\"say \"\"so\"\"\""))
            return;
        if (!reader.isAsking())
            return;
        at = end;
    }
    const std::size_t last = reader.getLine();
    if (!reader.finish())
        fail(last, "a quote is opened and never closed; close it");
}

std::string csvColumnRemedy(const std::vector<std::string>& fields)
{
    const bool isOther = fields.size() == 1 && fields[0].find_first_of(";\t") != std::string::npos;
    return isOther ? "; separate them by a comma" : "; quote a text that has a comma: \"a,b\"";
}

std::string quotedCsvField(const std::string& field)
{
    constexpr std::size_t mostBytes = 60;
    std::string shown = field.substr(0, mostBytes);
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    return "'" + shown + (field.size() > mostBytes ? "...'" : "'");
}

} // namespace osgLabels
