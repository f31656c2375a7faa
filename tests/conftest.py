from tests import effort

effort.register()
