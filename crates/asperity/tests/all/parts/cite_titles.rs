use asperity_reference::cite::titles::*;

#[test]
fn every_title_is_that_of_a_scene_of_the_product() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    let texts = std::fs::read_dir(folder).unwrap().filter_map(|entry| {
        let path = entry.unwrap().path();
        path.extension().is_some_and(|e| e == "toml").then(|| std::fs::read_to_string(path).unwrap())
    });
    let texts: Vec<String> = texts.collect();
    for (title, _) in TITLES {
        let line = format!("\ntitle = \"{title}\"\n");
        assert!(texts.iter().any(|text| text.contains(&line)), "no scene has the title {title}");
    }
}
