// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslSource.h>

#include <map>
#include <string>

namespace osgMultiRender
{

/// Changes of a source, made into a text in the end.
///
/// Where a change adds or removes lines, a `#line` follows it, so that the compiler's messages keep
/// the lines of the unchanged text (and the user's own `#line`). The source must outlive the edit.
/// Where two changes overlap the first one made wins.
class OSGMULTIRENDER_EXPORT GlslEdit
{
public:
    using Names = std::map<std::string, std::string, std::less<>>;

    explicit GlslEdit(const GlslSource& source);

    /// Renames global symbols (variables, functions with all overloads, types, built-ins, names of
    /// other shader objects) where they are meant: not locals of the same name nor members. Bodies
    /// of macros and conditions follow; where a macro's body may mean a local of that name, the
    /// locals are renamed alike. Returns the number of places.
    std::size_t rename(const Names& names);

    /// Renames words in each role: locals and members too, but not macros, nor names in `layout`.
    std::size_t renameWords(const Names& names);

    /// Removes the code of a range of tokens; comments, directives and line ends in it stay.
    void blank(const GlslRange& range);

    /// Removes the qualifiers of these names, with the brackets of "layout".
    void removeQualifiers(const GlslSpecifiers& specifiers, const std::vector<std::string>& words);

    /// Puts `text` in place of all qualifiers: "in" for "layout(location = 0) out".
    void setQualifiers(const GlslSpecifiers& specifiers, const std::string& text);

    /// Inserts text before a token, or at the end where `token` is the number of tokens. Before a
    /// directive it must end with a line end.
    void insertBefore(std::size_t token, const std::string& text);

    /// Replaces bytes [begin, end). A text that holds line ends must not lie within a directive.
    void replace(std::size_t begin, std::size_t end, const std::string& text);

    /// The changed text. `version` is the GLSL version of the result, which decides what `#line`
    /// means (below 330 the number of the line before); 0: that of the source.
    std::string getText(int version = 0) const;

private:
    struct Change
    {
        std::size_t begin, end;
        std::string text;
    };

    bool renamesHere(std::size_t token) const;
    std::size_t renameInDirective(const GlslDirective& directive, const Names& names,
                                  bool everyRole);

    const GlslSource& _source;
    std::vector<Change> _changes;
};

} // namespace osgMultiRender
