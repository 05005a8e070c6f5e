//! Files of VTK as VTK and meshio write them: `verification/independent/field_files.py`.
#![allow(clippy::disallowed_methods, clippy::unwrap_used)]

use asperity_output::fields::vtu::reading::{self, Grid};

const FORMS: [&str; 8] = [
    "vtk_ascii",
    "vtk_inline",
    "vtk_inline_plain_big",
    "vtk_end",
    "vtk_end_plain_wide",
    "vtk_end_base64_big",
    "meshio_zlib",
    "meshio_plain",
];

fn bytes(form: &str) -> Vec<u8> {
    std::fs::read(format!("{}/tests/vtu/{form}.vtu", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// Grid with the values at points, and those in cells.
fn both(form: &str) -> [Grid; 2] {
    ["a", "c"].map(|name| reading::read(&bytes(form), name).unwrap())
}

#[test]
fn every_form_gives_the_numbers_that_were_written() {
    for form in FORMS {
        let [at_points, in_cells] = both(form);
        let third = |k: u32| f64::from(k) / 3.0;
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[x, y]| [third(x), third(y)]);
        for (found, corner) in at_points.points.iter().zip(corners) {
            assert_eq!([found[0], found[1]], corner, "{form}");
        }
        assert_eq!(at_points.at_points[0].values, [1.0, 2.0, 4.0, 8.0].map(|v| v / 7.0), "{form}");
        assert_eq!(in_cells.in_cells[0].values, [1.0, 2.0].map(|v| v / 9.0), "{form}");
        let cells: Vec<(u8, &[usize])> = at_points.cells.iter().map(|c| (c.kind, &c.points[..])).collect();
        assert_eq!(cells, [(5, &[0, 1, 2][..]), (5, &[0, 2, 3])], "{form}");
    }
}

#[test]
fn a_form_that_is_not_read_is_named() {
    let error = reading::read(&bytes("meshio_lzma"), "a").unwrap_err();
    let message =
        "its attribute `compressor` is `vtkLZMADataCompressor`, and `vtkZLibDataCompressor` is read";
    assert_eq!(error.to_string(), message);
    let error = reading::read(&bytes("vtk_end"), "b").unwrap_err();
    assert_eq!(error.to_string(), "it has no array `b` at points or in cells");
    let text = "<VTKFile type=\"PolyData\"><PolyData/></VTKFile>";
    let error = reading::read(text.as_bytes(), "a").unwrap_err();
    assert_eq!(error.to_string(), "it is a `PolyData` of VTK, and `UnstructuredGrid` is read");
    assert_eq!(
        reading::read(b"<html></html>", "a").unwrap_err().to_string(),
        "it is no file of VTK: its first element is `html`"
    );
}

#[test]
fn a_file_that_ends_early_or_has_a_changed_byte_never_panics() {
    for form in FORMS {
        let whole = bytes(form);
        for length in 0..whole.len() {
            let _ = reading::read(&whole[..length], "a");
        }
        assert!(reading::read(&whole[..whole.len() / 2], "a").is_err(), "{form}");
        for at in 0..whole.len() {
            for value in [b'0', b'9', b'<', 0, 255] {
                let mut bytes = whole.clone();
                bytes[at] = value;
                let _ = reading::read(&bytes, "a");
            }
        }
    }
}

#[test]
fn counts_that_lie_do_not_exhaust_the_memory() {
    let head = |count: &str| {
        format!(
            "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece NumberOfPoints=\"{count}\" NumberOfCells=\"0\"><PointData><DataArray type=\"Float64\" Name=\"a\" format=\"binary\">//////////8=</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>"
        )
    };
    for count in ["18446744073709551615", "2305843009213693951", "1000000000"] {
        assert!(reading::read(head(count).as_bytes(), "a").is_err(), "{count}");
    }
}

/// A file of `points` points whose array `a` is zero, as zlib packs it: about a thousand zeros to a byte.
fn zeros(points: usize) -> Vec<u8> {
    let packed = {
        let mut out = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
        let zeros = vec![0; 1 << 16];
        (0..points * 8 / zeros.len()).for_each(|_| std::io::Write::write_all(&mut out, &zeros).unwrap());
        out.finish().unwrap()
    };
    let mut head = Vec::new();
    for number in [1, points * 8, 0, packed.len()] {
        head.extend_from_slice(&(number as u64).to_le_bytes());
    }
    let mut file = format!(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
         compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece NumberOfPoints=\"{points}\" \
         NumberOfCells=\"0\"><PointData><DataArray type=\"Float64\" Name=\"a\" format=\"appended\" \
         offset=\"0\"/></PointData></Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_"
    )
    .into_bytes();
    file.extend(head);
    file.extend(packed);
    file.extend(b"</AppendedData></VTKFile>");
    file
}

#[test]
fn an_array_that_unpacks_to_far_more_than_the_file_holds_is_refused_before_it_is_unpacked() {
    let error = reading::read(&zeros(1 << 24), "a").unwrap_err().to_string();
    assert!(error.starts_with("array `a`: it announces 16777216 values in "), "{error}");
    assert!(error.ends_with("more than 100 to one, as damaged files do"), "{error}");
}

#[test]
fn a_million_zeros_are_a_field_like_any_other() {
    // The points are missing: the array itself was read.
    assert_eq!(reading::read(&zeros(1 << 20), "a").unwrap_err().to_string(), "it has no `Points`");
}
