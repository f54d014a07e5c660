#include "formwork/panels/pdf_page.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

#include "arcsim/base/error.hpp"
#include "formwork/panels/dxf_text.hpp"

namespace formwork {
namespace {

constexpr double points_per_mm = 72 / 25.4;
constexpr double capital_share = 0.72;   // height of a capital over the font size

float pt(double mm) { return static_cast<float>(mm * points_per_mm); }

}  // namespace

void PdfDocument::on_error(HPDF_STATUS error, HPDF_STATUS detail, void* failure) {
    Failure& first = *static_cast<Failure*>(failure);
    if (first.error == 0) first = {error, detail};
}

PdfDocument::PdfDocument(const std::string& title) : doc_(HPDF_New(&on_error, &failure_), &HPDF_Free) {
    HPDF_SetCompressionMode(doc_.get(), HPDF_COMP_ALL);
    HPDF_SetInfoAttr(doc_.get(), HPDF_INFO_TITLE, ascii(title).c_str());
    HPDF_SetInfoAttr(doc_.get(), HPDF_INFO_CREATOR, "formwork");
    font_ = HPDF_GetFont(doc_.get(), "Helvetica", nullptr);
}

std::string PdfDocument::finish() {
    HPDF_SaveToStream(doc_.get());
    std::string bytes;
    if (failure_.error == 0) {
        std::vector<HPDF_BYTE> block(1 << 16);
        HPDF_ResetStream(doc_.get());
        for (HPDF_UINT32 size = 0; bytes.size() < HPDF_GetStreamSize(doc_.get());) {
            size = static_cast<HPDF_UINT32>(block.size());
            HPDF_ReadFromStream(doc_.get(), block.data(), &size);   // says "end of stream" with the last block
            if (size == 0) break;
            bytes.append(reinterpret_cast<const char*>(block.data()), size);
        }
    }
    if (failure_.error != 0 && failure_.error != HPDF_STREAM_EOF) {
        char code[48];
        std::snprintf(code, sizeof code, "error 0x%04lX, detail %lu", failure_.error, failure_.detail);
        throw arcsim::NumericalError(std::string("panels: libharu cannot write the PDF (") + code + ").");
    }
    return bytes;
}

PdfPage::PdfPage(PdfDocument& document, const Vector2d& size) : page_(HPDF_AddPage(document.doc_.get())), font_(document.font_) {
    HPDF_Page_SetWidth(page_, pt(size.x()));
    HPDF_Page_SetHeight(page_, pt(size.y()));
}

void PdfPage::colour(const Colour& c) {
    HPDF_Page_SetRGBStroke(page_, c.r, c.g, c.b);
    HPDF_Page_SetRGBFill(page_, c.r, c.g, c.b);
}

void PdfPage::width(double mm) { HPDF_Page_SetLineWidth(page_, pt(mm)); }

void PdfPage::dashed(bool on) {
    const HPDF_UINT16 dash[] = {4, 3};
    HPDF_Page_SetDash(page_, on ? dash : nullptr, on ? 2 : 0, 0);
}

void PdfPage::line(const Line& line, bool closed) {
    if (line.size() < 2) return;
    HPDF_Page_MoveTo(page_, pt(line[0].x()), pt(line[0].y()));
    for (std::size_t i = 1; i < line.size(); ++i) HPDF_Page_LineTo(page_, pt(line[i].x()), pt(line[i].y()));
    if (closed) HPDF_Page_ClosePath(page_);
    HPDF_Page_Stroke(page_);
}

void PdfPage::box(const Vector2d& low, const Vector2d& size) {
    HPDF_Page_Rectangle(page_, pt(low.x()), pt(low.y()), pt(size.x()), pt(size.y()));
    HPDF_Page_Stroke(page_);
}

void PdfPage::clip_to(const Vector2d& low, const Vector2d& size) {
    HPDF_Page_GSave(page_);
    HPDF_Page_Rectangle(page_, pt(low.x()), pt(low.y()), pt(size.x()), pt(size.y()));
    HPDF_Page_Clip(page_);
    HPDF_Page_EndPath(page_);
}

void PdfPage::end_clip() { HPDF_Page_GRestore(page_); }

void PdfPage::text(const Vector2d& at, double capital_mm, double angle, const std::string& string, bool centred) {
    const std::string shown = ascii(string);
    HPDF_Page_SetFontAndSize(page_, font_, pt(capital_mm / capital_share));
    const double shift = centred ? HPDF_Page_TextWidth(page_, shown.c_str()) / 2 / points_per_mm : 0;
    const float c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    HPDF_Page_BeginText(page_);
    HPDF_Page_SetTextMatrix(page_, c, s, -s, c, pt(at.x() - shift * c), pt(at.y() - shift * s));
    HPDF_Page_ShowText(page_, shown.c_str());
    HPDF_Page_EndText(page_);
}

}  // namespace formwork
