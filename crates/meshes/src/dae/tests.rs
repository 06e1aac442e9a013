//! Small COLLADA documents, written out in each test.

use nalgebra::Point3;

use super::parse;
use crate::mesh_file::MeshFile;

/// A right triangle with legs of one unit along x and y, inside `scene`.
fn document(asset: &str, primitive: &str, scene: &str) -> String {
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"><asset>{asset}</asset>
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
<technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
{primitive}</mesh></geometry></library_geometries>
<library_nodes><node id="shared"><instance_geometry url="#g"/></node></library_nodes>
<library_visual_scenes><visual_scene id="scene">{scene}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>"##
    )
}

const INPUT: &str = r##"<input semantic="VERTEX" source="#v" offset="0"/>"##;
const PLAIN: &str = r##"<node><instance_geometry url="#g"/></node>"##;

fn one_triangle() -> String {
    format!("<triangles>{INPUT}<p>0 1 2</p></triangles>")
}

#[track_caller]
fn triangles(primitive: &str, expected: &[[u32; 3]]) {
    let mesh = parse(document("", primitive, PLAIN).as_bytes()).unwrap();
    assert_eq!(mesh.triangles, expected);
}

#[test]
fn every_primitive_becomes_triangles() {
    triangles(&one_triangle(), &[[0, 1, 2]]);
    triangles(
        &format!("<polylist>{INPUT}<vcount>3 4</vcount><p>0 1 2 0 1 2 3</p></polylist>"),
        &[[0, 1, 2], [0, 1, 2], [0, 2, 3]],
    );
    triangles(
        &format!("<polygons>{INPUT}<p>0 1 2</p><p>0 1 2 3</p></polygons>"),
        &[[0, 1, 2], [0, 1, 2], [0, 2, 3]],
    );
    triangles(&format!("<tristrips>{INPUT}<p>0 1 2 3</p></tristrips>"), &[[0, 1, 2], [1, 3, 2]]);
    triangles(&format!("<trifans>{INPUT}<p>0 1 2 3</p></trifans>"), &[[0, 1, 2], [0, 2, 3]]);
    let normal = r#"<input semantic="NORMAL" offset="1"/>"#;
    triangles(&format!("<triangles>{INPUT}{normal}<p>0 9 1 9 2 9</p></triangles>"), &[[0, 1, 2]]);
    triangles(&format!("<lines>{INPUT}<p>0 1</p></lines>"), &[]);
}

/// Rounding of a quarter turn; worst seen 6.2e-17.
const ROUNDING: f64 = 1e-15;

#[track_caller]
fn corner(asset: &str, scene: &str, expected: Point3<f64>) {
    let mesh = parse(document(asset, &one_triangle(), scene).as_bytes()).unwrap();
    let found = mesh.vertices_m[1];
    assert!((found - expected).norm() < ROUNDING, "{found} is not {expected}");
}

#[test]
fn unit_and_transforms_are_applied_and_the_up_axis_is_not() {
    let geometry = r##"<instance_geometry url="#g"/>"##;
    corner(r#"<unit meter="0.001"/>"#, PLAIN, Point3::new(0.001, 0.0, 0.0));
    corner("<unit/><up_axis>Y_UP</up_axis>", PLAIN, Point3::new(1.0, 0.0, 0.0));
    let chain = format!(
        "<node><translate>1 2 3</translate><rotate>0 0 1 90</rotate>\
         <node><scale>2 1 1</scale>{geometry}</node></node>"
    );
    corner("", &chain, Point3::new(1.0, 4.0, 3.0));
    let matrix = format!("<node><matrix>0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1</matrix>{geometry}</node>");
    corner("", &matrix, Point3::new(5.0, 7.0, 7.0));
    let shared = r##"<node><translate>1 0 0</translate><instance_node url="#shared"/></node>"##;
    corner("", shared, Point3::new(2.0, 0.0, 0.0));
}

#[test]
fn a_mirrored_node_keeps_the_outside_out() {
    let scene = r##"<node><scale>-1 1 1</scale><instance_geometry url="#g"/></node>"##;
    let mesh = parse(document("", &one_triangle(), scene).as_bytes()).unwrap();
    assert_eq!(mesh.triangles, [[0, 2, 1]]);
}

#[test]
fn an_empty_scene_is_an_empty_mesh() {
    assert_eq!(parse(document("", &one_triangle(), "<node/>").as_bytes()), Ok(MeshFile::default()));
}

#[track_caller]
fn refused(text: &str, message: &str) {
    let error = parse(text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains(message), "{error}");
}

#[test]
fn faults_are_named() {
    let good = document("", &one_triangle(), PLAIN);
    refused("<a/>", "line 1: the root element is <a>, not <COLLADA>");
    refused(&good.replace("source=\"#s\"", "source=\"#nowhere\""), "line 5: <source> \"#nowhere\" not found");
    refused(&good.replace("0 1 2<", "0 1 4<"), "vertex index 4 is out of range: there are 4 vertices");
    refused(&good.replace("0 1 2<", "0 1<"), "2 corners are not a whole number");
    refused(
        &good.replace("count=\"4\"", "count=\"5\""),
        "<accessor> declares 5 positions of 3 numbers, but the array holds 12",
    );
    refused(&good.replace("count=\"4\"", "count=\"18446744073709551615\""), "but the array holds");
    refused(&good.replace("0 0 1<", "0 0 x<"), "\"x\" is not a number");
    refused(&document("<unit meter=\"0\"/>", "", PLAIN), "not a positive number");
    let too_many = format!("<polylist>{INPUT}<vcount>9</vcount><p>0 1 2</p></polylist>");
    refused(&document("", &too_many, PLAIN), "<vcount> counts more corners");
}

#[test]
fn nodes_that_instance_themselves_end() {
    let scene = r##"<node id="n"><instance_node url="#n"/><instance_node url="#n"/></node>"##;
    refused(&document("", &one_triangle(), scene), "more than 100000 nodes");
}

#[test]
fn cut_files_never_panic() {
    let whole = document("<unit meter=\"1\"/>", &one_triangle(), PLAIN);
    for end in 0..whole.len() {
        let _ = parse(&whole.as_bytes()[..end]);
    }
}
