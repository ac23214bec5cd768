// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslEdit.h>
#include <osgMultiRender/GlslWrap.h>

#include <set>

namespace osgMultiRender
{

/// One fragment shader object on its way to a callable function. Used by wrapProgram().
class GlslFragment
{
public:
    GlslFragment(const GlslSource& source, std::size_t shader);

    /// Finds main, outputs and uses of gl_FragColor and gl_FragData; adds outputs and errors.
    void read(GlslWrapped& result);

    bool definesMain() const { return _definesMain; }
    bool usesColor() const { return _usesColor; }
    bool usesData() const { return _usesData; }
    bool dataIndexedFreely() const { return _dataIndexedFreely; }
    const std::set<int>& dataElements() const { return _dataElements; }

    /// Makes gl_FragColor the first element of gl_FragData.
    void foldColorIntoData() { _foldColor = true; }

    /// Adds its changes to `edit` and its renames to `names`.
    void edit(GlslEdit& edit, GlslEdit::Names& names) const;

private:
    void findMain();
    void findBuiltins(GlslWrapped& result);
    void useOfData(const std::vector<std::string_view>& next);
    void addOutput(const GlslDeclaration& one, GlslWrapped& result);
    void readLayout(const GlslDeclaration& one, GlslOutput& output, GlslWrapped& result);
    bool isOutput(const GlslDeclaration& one) const;
    long long constant(std::size_t first, std::size_t last, bool& known) const;
    std::string typeOf(const GlslSpecifiers& specifiers) const;
    void insertDeclarations(GlslEdit& edit) const;
    void say(std::vector<GlslWrapMessage>& list, std::size_t token,
             const std::string& message) const;

    const GlslSource* _source;
    std::size_t _shader;
    bool _definesMain = false;
    bool _usesColor = false;
    bool _usesData = false;
    bool _dataIndexedFreely = false;
    bool _foldColor = false;
    std::set<int> _dataElements;
    std::set<std::string> _outputs;
};

/// Adds the outputs of gl_FragColor and gl_FragData over all shader objects of the stage.
void mergeFragmentBuiltins(std::vector<GlslFragment>& fragments, GlslWrapped& result);

} // namespace osgMultiRender
