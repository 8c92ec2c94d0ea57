"""Run by the editor when it starts: installs the skin's table and material once."""

import unreal

import dermis_skin


def install_once(_seconds):
    # Assets can be imported from the first frame on.
    unreal.unregister_slate_post_tick_callback(handle)
    if not unreal.EditorAssetLibrary.does_asset_exist(dermis_skin.TABLE):
        dermis_skin.install()


handle = unreal.register_slate_post_tick_callback(install_once)
