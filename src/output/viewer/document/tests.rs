use super::*;

fn viewer_data() -> ViewerData {
    let place =
        |first: usize, weights: &[f64]| PointCombination { first, weights: weights.to_vec() };
    ViewerData {
        label: "swing".into(),
        times: vec![0.0, 0.5],
        points: vec![vec![(0.0, 0.0), (2.0, 0.0)], vec![(0.0, 0.0), (0.0, 2.0)]],
        beams: vec![BeamShape {
            name: "rod".into(),
            line: vec![place(0, &[1.0, 0.0]), place(0, &[0.0, 1.0])],
            marks: vec![0, 1],
            stations: vec![0, 1],
        }],
        ..ViewerData::default()
    }
}

#[test]
fn texts_are_escaped_in_the_page() {
    let title = "</script><script>alert('{{data}}')</script> & \"so on\"";
    let viewer_data = ViewerData { label: title.into(), ..viewer_data() };
    let page = Viewer { title: title.into(), motions: vec![viewer_data] }.to_html().unwrap();
    assert!(!page.contains("alert('{{data}}')<"), "the title is escaped");
    assert_eq!(page.matches("</script>").count(), 2, "of the data and of the program");
    assert!(page.contains("&lt;/script&gt;&lt;script&gt;alert(&#39;{{data}}&#39;)&lt;/script&gt; &amp; &quot;so on&quot;"));
    assert!(page.contains(r"\u003c/script>\u003cscript>alert('{{data}}')"));
}

#[test]
fn page_is_complete_and_loads_no_external_resources() {
    let page = Viewer { title: "t".into(), motions: vec![viewer_data()] }.to_html().unwrap();
    for mark in ["{{", "http:", "https:", " src=", "fetch(", "import(", "@import", "url("] {
        assert!(!page.contains(mark), "{mark}");
    }
    assert!(page.contains("default-src 'none'") && page.trim_end().ends_with("</html>"));
    let again = Viewer { title: "t".into(), motions: vec![viewer_data()] }.to_html().unwrap();
    assert_eq!(page, again);
}

#[test]
fn beams_with_equal_meshes_share_one_shape() {
    let mut two = viewer_data();
    two.points.iter_mut().for_each(|points| points.extend([(5.0, 5.0), (6.0, 6.0)]));
    let mut other = two.beams[0].clone();
    other.line.iter_mut().for_each(|place| place.first += 2);
    two.beams.push(other);
    let packed = packed_motion(&two).unwrap();
    assert_eq!(packed["shapes"].as_array().unwrap().len(), 1);
    assert_eq!(packed["beams"][1]["first"], 2);
}

#[test]
fn packed_data_contains_obstacles_with_their_visible_points() {
    let place = |symbol, at, direction| PlacedSymbol { symbol, at, direction };
    let floor = place(Symbol::Wall, (5.0, -0.25), (0.0, 1.0));
    let peg = place(Symbol::Disc, (3.0, 1.0), (0.5, 0.0));
    let obstacles = vec![("floor".into(), floor), ("peg".into(), peg)];
    let packed = packed_motion(&ViewerData { obstacles, ..viewer_data() }).unwrap();
    let [floor, peg] = packed["obstacles"].as_array().unwrap().as_slice() else { panic!() };
    assert_eq!((&floor["kind"], &floor["name"]), (&json!("wall"), &json!("floor")));
    assert_eq!(floor["shown"][0][1], -0.25);
    assert_eq!((&peg["kind"], &peg["direction"]), (&json!("disc"), &json!([0.5, 0.0])));
    assert_eq!(peg["shown"].as_array().unwrap().len(), 4);
}

#[test]
fn viewer_without_bodies_gives_a_page() {
    let nothing = ViewerData { times: vec![0.0], points: vec![vec![]], ..ViewerData::default() };
    assert!(Viewer { title: String::new(), motions: vec![nothing] }.to_html().is_ok());
}
